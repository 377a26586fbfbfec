// The highest frequency by Lanczos's method: closer than the bound, but no upper bound.
#include "mechanics/step/step_bounds.hpp"
#include "mechanics/ties/ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace kaya {

namespace {

constexpr std::size_t steps = 40;
constexpr std::size_t last_steps = 10;

using Vector = std::vector<double>;

Vec3 three(const Vector& x, std::size_t at) { return {x[at], x[at + 1], x[at + 2]}; }
void add_three(Vector& y, std::size_t at, const Vec3& v) {
    for (int k = 0; k < 3; ++k) y[at + static_cast<std::size_t>(k)] += v[k];
}

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Largest eigenvalue of the symmetric tridiagonal matrix, by bisection.
double largest_eigenvalue(const Vector& diagonal, const Vector& off_diagonal, std::size_t count) {
    double low = 0, high = 0;
    for (std::size_t i = 0; i < count; ++i)
        high = std::max(high, diagonal[i] + (i > 0 ? off_diagonal[i - 1] : 0) + (i + 1 < count ? off_diagonal[i] : 0));
    // No eigenvalue lies above x when all pivots of the matrix minus x are below 0.
    const auto above_all = [&](double x) {
        double pivot = 0;
        for (std::size_t i = 0; i < count; ++i) {
            pivot = diagonal[i] - x - (i > 0 ? off_diagonal[i - 1] * off_diagonal[i - 1] / pivot : 0);
            if (!(pivot < 0)) return false;
        }
        return true;
    };
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (above_all(middle) ? high : low) = middle;
    }
    return high;
}

/// Volume and gradients of the shape functions of a zone.
struct ZoneShape {
    std::array<Vec3, 4> gradient;
    double volume;

    ZoneShape(const Model& model, std::size_t z) {
        std::array<Vec3, 4> x;
        for (int a = 0; a < 4; ++a) x[a] = model.gridpoints.position[model.zones.gridpoints[z][a]];
        const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
        const Vec3 c1 = e2.cross(e3), c2 = e3.cross(e1), c3 = e1.cross(e2);
        const double six_volumes = e1.dot(c1);
        volume = six_volumes / 6;
        gradient = {-(c1 + c2 + c3) / six_volumes, c1 / six_volumes, c2 / six_volumes, c3 / six_volumes};
    }
};

} // namespace

/// Products for Lanczos's method: M^-1/2 (K + 2 C/step) M^-1/2, bodies and gridpoints in row order.
class StepBounds::Operator {
public:
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

    Operator(const Model& model, const StepBounds& bounds, double step)
        : model_(model), bounds_(bounds), step_(step), at_block_(model.blocks.size(), nowhere),
          at_point_(model.gridpoints.size(), nowhere) {
        for (std::size_t b = 0; b < model.blocks.size(); ++b) {
            const Row row = static_cast<Row>(b);
            if (model.blocks.deformable[b] || bounds.lead_[b] != row || !bounds.frames_[b].moves()) continue;
            at_block_[b] = size_;
            size_ += 6;
        }
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g) {
            if (!model.blocks.deformable[model.gridpoints.block[g]] || bounds.root_of_gridpoint_[g] == 0) continue;
            at_point_[g] = size_;
            size_ += 3;
        }
        if (model.zones.size() == 0) return;
        elastic_ = *bounds.of_zones;
        ties_ = TieLists(model, elastic_);
    }
    std::size_t size() const { return size_; }

    Vector operator*(const Vector& x) const {
        Vector y(size_, 0.0);
        const auto& contacts = model_.contacts;
        const auto& subs = model_.sub_contacts;
        for (std::size_t c = 0; c < contacts.size(); ++c) {
            const Row row = static_cast<Row>(c);
            const NormalAreaFactor factor(model_, row);
            const Beta beta = bounds_.damped_ ? bounds_.beta_[c] : Beta{};
            const Vec3& n = contacts.normal[c];
            for (Row s = contacts.sub_contacts[c].first; s < contacts.sub_contacts[c].end(); ++s) {
                const Springs k = bounds_.springs(model_, s, factor);
                const auto shift = [&](const Vec3& place) -> Vec3 {
                    return motion(x, contacts.block2[c], subs.side2[s], place) -
                           motion(x, contacts.block1[c], subs.side1[s], place);
                };
                const auto push_apart = [&](const Vec3& place, const Vec3& force) {
                    push(y, contacts.block2[c], subs.side2[s], place, force);
                    push(y, contacts.block1[c], subs.side1[s], place, -force);
                };
                const bool loaded = s < factor.others;
                const Vec3 place = loaded ? subs.position[s] : contacts.position[c],
                           of_shear = loaded ? subs.shear_place(s) : place, slip = shift(of_shear);
                push_apart(place, k.normal * (1 + 2 * beta.normal / step_) * shift(place).dot(n) * n);
                push_apart(of_shear, k.shear * (1 + 2 * beta.shear / step_) * (slip - slip.dot(n) * n));
            }
        }
        add_zones(x, y);
        add_ties(x, y);
        return y;
    }

private:
    Vec3 of_point(const Vector& x, Row g) const {
        return at_point_[g] == nowhere ? Vec3::Zero() : Vec3(bounds_.root_of_gridpoint_[g] * three(x, at_point_[g]));
    }
    void push_point(Vector& y, Row g, const Vec3& force) const {
        if (at_point_[g] != nowhere) add_three(y, at_point_[g], bounds_.root_of_gridpoint_[g] * force);
    }
    static Vec3 free(Vec3 v, unsigned fixed) {
        for (int k = 0; k < 3; ++k)
            if (fixed & (1u << k)) v[k] = 0;
        return v;
    }
    Vec3 motion(const Vector& x, Row block, const Attachment& side, const Vec3& place) const {
        if (model_.blocks.deformable[block]) {
            Vec3 sum = Vec3::Zero();
            for (int k = 0; k < 3; ++k)
                if (side.weights[k] != 0) sum += side.weights[k] * of_point(x, side.gridpoints[k]);
            return sum;
        }
        const Row lead = bounds_.lead_[block];
        const std::size_t at = at_block_[lead];
        if (at == nowhere) return Vec3::Zero();
        const BodyFrame& frame = bounds_.frames_[lead];
        const Vec3 spin = frame.root_of_inertia.transpose() * three(x, at + 3);
        return frame.root_of_mass * free(three(x, at), frame.fixed) + spin.cross(place - frame.centre);
    }
    void push(Vector& y, Row block, const Attachment& side, const Vec3& place, const Vec3& force) const {
        if (model_.blocks.deformable[block]) {
            for (int k = 0; k < 3; ++k)
                if (side.weights[k] != 0) push_point(y, side.gridpoints[k], side.weights[k] * force);
            return;
        }
        const Row lead = bounds_.lead_[block];
        const std::size_t at = at_block_[lead];
        if (at == nowhere) return;
        const BodyFrame& frame = bounds_.frames_[lead];
        add_three(y, at, frame.root_of_mass * free(force, frame.fixed));
        add_three(y, at + 3, frame.root_of_inertia * (place - frame.centre).cross(force));
    }
    void add_zones(const Vector& x, Vector& y) const {
        const double more = 1 + 2 * stiffness_damping(model_.settings) / step_;
        for (std::size_t z = 0; z < model_.zones.size(); ++z) {
            const ZoneShape shape(model_, z);
            const auto& corners = model_.zones.gridpoints[z];
            Mat3 gradient = Mat3::Zero();
            for (int a = 0; a < 4; ++a) gradient += of_point(x, corners[a]) * shape.gradient[a].transpose();
            const auto& [lambda, two_shear] = elastic_[model_.zones.block[z]];
            Mat3 stress = 0.5 * two_shear * (gradient + gradient.transpose());
            stress.diagonal().array() += lambda * gradient.trace();
            for (int a = 0; a < 4; ++a) push_point(y, corners[a], more * shape.volume * (stress * shape.gradient[a]));
        }
    }

    /// Springs of ties. Exactly tied gridpoints count as free, which allows no longer step.
    void add_ties(const Vector& x, Vector& y) const {
        const double more = 1 + 2 * stiffness_damping(model_.settings) / step_;
        for (const auto& spring : ties_.springs()) {
            Vec3 shift = Vec3::Zero();
            for (int side = 0; side < 2; ++side)
                for (int k = 0; k < 3; ++k)
                    shift += (side == 0 ? -1 : 1) * spring.side[side].weights[k] *
                             of_point(x, spring.side[side].gridpoints[k]);
            for (int side = 0; side < 2; ++side)
                for (int k = 0; k < 3; ++k)
                    push_point(y, spring.side[side].gridpoints[k],
                               (side == 0 ? -1 : 1) * spring.side[side].weights[k] * more * spring.stiffness * shift);
        }
    }

    const Model& model_;
    const StepBounds& bounds_;
    double step_;
    std::vector<std::size_t> at_block_, at_point_;
    std::vector<ElasticConstants> elastic_;
    TieLists ties_;
    std::size_t size_ = 0;
};

// The largest Ritz value rises to the largest eigenvalue. The increase of the last steps is added once more.
double StepBounds::estimate(const Model& model, const Adjacency& adjacency, double step) {
    update(model, adjacency);
    find_resistances(model, adjacency, Masses::inertial);
    const Operator matrix(model, *this, step);
    const std::size_t n = matrix.size(), most = std::min(steps, n);
    if (n == 0) return 0;
    Vector now(n), before(n, 0.0), diagonal, off_diagonal;
    std::uint64_t bits = 1; // no direction is left out
    for (double& x : now) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        x = static_cast<double>(bits >> 11) * 0x1p-53 - 0.5;
    }
    const double length = std::sqrt(dot(now, now));
    for (double& x : now) x /= length;
    double last = 0;
    while (diagonal.size() < most) {
        Vector next = matrix * now;
        const double along = dot(next, now);
        for (std::size_t i = 0; i < n; ++i) next[i] -= along * now[i] + last * before[i];
        last = std::sqrt(dot(next, next));
        diagonal.push_back(along);
        off_diagonal.push_back(last);
        if (!(last > 1e-12 * diagonal.front())) break;
        before.swap(now);
        for (std::size_t i = 0; i < n; ++i) now[i] = next[i] / last;
    }
    const std::size_t count = diagonal.size();
    const double largest = largest_eigenvalue(diagonal, off_diagonal, count);
    if (count < steps) return largest;
    return 2 * largest - largest_eigenvalue(diagonal, off_diagonal, count - last_steps);
}

} // namespace kaya
