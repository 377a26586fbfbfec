#include "mechanics/supports/loads_to_zones.hpp"

#include "mechanics/supports/boundary.hpp"
#include "model/edit/placed_loads.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace kaya {

namespace {

/// A traction is put on the gridpoints from this many parts of each side of its triangle.
constexpr int parts = 8;

/// Forces at gridpoints, by function of time.
class GridpointForces {
public:
    GridpointForces(const Model& model, Row block) : model_(model), block_(block) {}

    void add(const Vec3& force, const Vec3& place, std::int32_t function) {
        Row best = no_row;
        Vec3 weights;
        double least = std::numeric_limits<double>::infinity();
        const Span span = model_.blocks.triangles[block_];
        for (Row t = span.first; t < span.end(); ++t) {
            const Vec3 found = weights_in(t, place);
            // How far it is outside of the triangle, and above it.
            const double outside = std::max(0.0, -found.minCoeff());
            const Vec3 area = triangle_area_vector(model_, t), corner = at(t, 0);
            const double above = std::abs(area.normalized().dot(place - corner)) / std::sqrt(area.norm());
            if (outside + above < least) least = outside + above, best = t, weights = found;
        }
        if (best == no_row) return;
        for (std::size_t k = 0; k < 3; ++k)
            forces_[{function, model_.triangles.gridpoints[best][k]}] += weights[static_cast<int>(k)] * force;
    }

    void give(Model& model) const {
        for (const auto& [at, force] : forces_)
            for (int axis = 0; axis < 3; ++axis)
                if (force[axis] != 0) add_load(model, {at.second}, axis, force[axis], at.first);
    }

private:
    struct Zero : Vec3 {
        Zero() : Vec3(Vec3::Zero()) {}
    };
    Vec3 at(Row triangle, std::size_t corner) const {
        return model_.gridpoints.position[model_.triangles.gridpoints[triangle][corner]];
    }
    /// They sum to 1, and interpolate the place projected into the plane.
    Vec3 weights_in(Row triangle, const Vec3& place) const {
        const Vec3 area = triangle_area_vector(model_, triangle);
        Vec3 weights;
        for (std::size_t k = 0; k < 3; ++k)
            weights[static_cast<int>(k)] =
                area.dot(triangle_area_vector(place, at(triangle, (k + 1) % 3), at(triangle, (k + 2) % 3))) /
                area.squaredNorm();
        return weights;
    }

    const Model& model_;
    Row block_;
    std::map<std::pair<std::int32_t, Row>, Zero> forces_;
};

/// A point load has all corners at one place. A linear traction is taken up at the middles of the sides of small triangles, which integrate its force
/// and moment exactly.
void spread(const PlacedLoad& load, GridpointForces& forces) {
    const Vec3 area = triangle_area_vector(load.place[0], load.place[1], load.place[2]);
    const Vec3 sum = load.force[0] + load.force[1] + load.force[2];
    if (!(area.norm() > 0)) return forces.add(sum, load.place[0], load.function);
    // Consistent loads (2 t_k + t_l + t_m)/12 A of tractions t at the corners.
    std::array<Vec3, 3> traction;
    for (std::size_t k = 0; k < 3; ++k) traction[k] = 12 * load.force[k] - 3 * sum; // times the area
    const auto put = [&](const Vec3& a, const Vec3& b) {
        const Vec3 at = 0.5 * (a + b); // weights of the corners
        Vec3 place = Vec3::Zero(), force = place;
        for (std::size_t k = 0; k < 3; ++k) {
            place += at[static_cast<int>(k)] * load.place[k];
            force += at[static_cast<int>(k)] * traction[k];
        }
        forces.add(force / (3.0 * parts * parts), place, load.function);
    };
    const auto node = [](int i, int j) -> Vec3 { return Vec3(i, j, parts - i - j) / parts; };
    for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j)
            for (const bool upper : {false, true}) {
                if (upper && i + j + 1 == parts) continue;
                const Vec3 a = upper ? node(i + 1, j + 1) : node(i, j), b = node(i + 1, j), c = node(i, j + 1);
                put(a, b);
                put(b, c);
                put(c, a);
            }
}

/// Forces without places, and moments, constant or in time.
bool has_more(const Model& model, Row block, const std::vector<PlacedLoad>& placed) {
    constexpr double rounding = 1e-9;
    std::map<std::int32_t, std::pair<Vec3, double>> by_function; // what is left, and the size of all
    const auto add = [&](std::int32_t function, const Vec3& force) {
        auto& [left, size] = by_function.try_emplace(function, Vec3::Zero(), 0).first->second;
        left += force;
        size += force.norm();
    };
    add(constant_in_time, model.blocks.load[block]);
    for (const PlacedLoad& load : placed) add(load.function, -(load.force[0] + load.force[1] + load.force[2]));
    const auto& histories = model.boundary_histories;
    bool moment = !model.blocks.torque[block].isZero(0);
    for (std::size_t i = 0; i < histories.size(); ++i) {
        if (histories.what[i] != BoundaryHistories::What::load || histories.block[i] != model.blocks.id[block])
            continue;
        const std::int32_t component = histories.component[i];
        if (component < 3) add(histories.function[i], histories.amplitude[i] * Vec3::Unit(component));
        moment = moment || (component >= 3 && component < BoundaryHistories::motions);
    }
    return moment || std::ranges::any_of(by_function, [](const auto& of) {
               return of.second.first.norm() > rounding * of.second.second;
           });
}

} // namespace

std::vector<std::int32_t> put_loads_on_zones(Model& model, const std::vector<Row>& blocks) {
    std::vector<std::int32_t> lost;
    for (const Row block : blocks) {
        if (!model.blocks.deformable[block]) continue;
        const std::vector<PlacedLoad> loads = take_placed_loads(model, block);
        if (has_more(model, block, loads)) lost.push_back(model.blocks.number[block]);
        model.blocks.load[block].setZero();
        model.blocks.torque[block].setZero();
        model.blocks.load_arms[block].setZero();
        GridpointForces forces(model, block);
        for (const PlacedLoad& load : loads) spread(load, forces);
        forces.give(model);
    }
    return lost;
}

} // namespace kaya
