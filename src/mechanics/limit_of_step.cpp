#include "mechanics/phases.hpp"

#include "base/reduce.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;

bool held(const Model& model, Row gridpoint) { return (model.gridpoints.fixed[gridpoint] & 7) == 7; }

/// Size of a sub-contact's row at one of its nodes, in coordinates scaled by the roots of the masses:
/// w / sqrt(m) at a gridpoint, sqrt(1/m + r^2/I) at a rigid block with its least moment of inertia I.
/// With masses of one: w, and sqrt(1 + r^2 m/I).
class NodeSize {
public:
    NodeSize(const Model& model, const JoinedBodies& bodies, Masses masses)
        : model_(model), masses_(masses), mass_(model.blocks.size(), 0), centroid_(model.blocks.centroid),
          least_inertia_(model.blocks.size(), 0) {
        const auto& blocks = model.blocks;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            if (blocks.deformable[b] || blocks.mass[b] <= 0) continue;
            mass_[b] = masses == Masses::real ? blocks.mass[b] : masses == Masses::inertial ? blocks.inertial_mass[b] : 1;
            Eigen::SelfAdjointEigenSolver<Mat3> solver;
            solver.computeDirect(blocks.inertia[b], Eigen::EigenvaluesOnly);
            least_inertia_[b] = solver.eigenvalues()[0] * mass_[b] / blocks.volume[b];
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const auto members = bodies.members(i);
            const BodyMass body = body_mass(model, members);
            Eigen::SelfAdjointEigenSolver<Mat3> solver;
            solver.computeDirect(body.inertia, Eigen::EigenvaluesOnly);
            const Row lead = members.front();
            const double factor = masses == Masses::unit                                     ? 1 / body.mass
                                  : masses == Masses::inertial && blocks.mass[lead] > 0 ? mass_[lead] / blocks.mass[lead]
                                                                                         : 1;
            std::uint8_t fixed = 0;
            for (const Row b : members) fixed |= blocks.fixed[b];
            for (const Row b : members) {
                centroid_[b] = body.centroid;
                least_inertia_[b] = factor * solver.eigenvalues()[0];
            }
            for (const Row b : members) mass_[b] = fixed == fix_all ? 0 : factor * body.mass;
        }
    }

    double gridpoint(Row g, double weight) const {
        if (held(model_, g)) return 0;
        const auto& points = model_.gridpoints;
        return masses_ == Masses::unit ? weight
                                       : weight / std::sqrt(masses_ == Masses::real ? points.mass[g] : points.inertial_mass[g]);
    }
    double block(Row b, Row sub_contact) const {
        const auto& blocks = model_.blocks;
        if (blocks.fixed[b] == fix_all || mass_[b] <= 0) return 0;
        const double arm2 = (model_.sub_contacts.position[sub_contact] - centroid_[b]).squaredNorm();
        return std::sqrt(1 / mass_[b] + arm2 / least_inertia_[b]);
    }
    /// Over all nodes of a side.
    double side(Row block_row, const Attachment& attachment, Row sub_contact) const {
        if (!model_.blocks.deformable[block_row]) return block(block_row, sub_contact);
        double sum = 0;
        for (int k = 0; k < 3; ++k)
            if (attachment.weights[k] != 0) sum += gridpoint(attachment.gridpoints[k], attachment.weights[k]);
        return sum;
    }

private:
    const Model& model_;
    Masses masses_;
    std::vector<double> mass_; ///< of a joined block: of the whole body, like the two below; 0 when it is held
    std::vector<Vec3> centroid_;
    std::vector<double> least_inertia_;
};

/// Sums of the absolute values in the rows of the joints' stiffness matrix, in the coordinates of NodeSize.
class RowSums {
public:
    RowSums(const Model& model, const Adjacency& adjacency, Masses masses)
        : model_(model), adjacency_(adjacency), size_(model, adjacency.bodies, masses),
          coupling_(model.sub_contacts.size()) {
        const auto& subs = model.sub_contacts;
        for_chunks(subs.size(), grain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const Row s = static_cast<Row>(i);
                const double stiffness = std::max(subs.normal_stiffness[s], subs.shear_stiffness[s]) * subs.area[s];
                const Row c = subs.contact[s];
                coupling_[s] = stiffness * (size_.side(model.contacts.block1[c], subs.side1[s], s) +
                                            size_.side(model.contacts.block2[c], subs.side2[s], s));
            }
        });
    }

    /// On top of `sum`.
    double gridpoint(Row row, double sum) const {
        for (auto e = adjacency_.of_gridpoint.begin(row); e != adjacency_.of_gridpoint.end(row); ++e)
            sum += size_.gridpoint(row, e->weight) * coupling_[e->sub_contact];
        return sum;
    }
    double block(Row row) const {
        double sum = 0;
        for (auto e = adjacency_.of_block.begin(row); e != adjacency_.of_block.end(row); ++e) {
            const Span span = model_.contacts.sub_contacts[e->contact];
            for (Row s = span.first; s < span.end(); ++s) sum += size_.block(row, s) * coupling_[s];
        }
        return sum;
    }

    /// Of joined blocks together.
    double body(std::size_t i) const {
        double sum = 0;
        for (const Row b : adjacency_.bodies.members(i)) sum += block(b);
        return sum;
    }

private:
    const Model& model_;
    const Adjacency& adjacency_;
    NodeSize size_;
    std::vector<double> coupling_;
};

void take_larger(StepLimit& limit, const StepLimit& other) {
    if (other.frequency_squared > limit.frequency_squared) limit = other;
}

/// The largest of a number that `of` gives for each row.
template <class Of> StepLimit largest(std::size_t rows, bool of_block, const Of& of) {
    return reduce_chunks(
        rows, grain, StepLimit{},
        [&](std::size_t first, std::size_t last) {
            StepLimit part;
            for (std::size_t i = first; i < last; ++i)
                take_larger(part, {of(static_cast<Row>(i)), of_block, static_cast<Row>(i)});
            return part;
        },
        take_larger);
}

} // namespace

// Gershgorin's theorem on the scaled stiffness matrix: a sub-contact of stiffness k couples its nodes i
// and j with at most k s_i s_j, s being the sizes above, so every eigenvalue is below the largest of
// sum over sub-contacts of k s_i (sum over its nodes of s_j), to which the zones add theirs.
StepLimit limit_of_step(const Model& model, const Adjacency& adjacency, Masses masses) {
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    const auto& of_points = masses == Masses::real ? points.mass : points.inertial_mass;
    const RowSums rows(model, adjacency, masses);
    StepLimit limit = largest(points.size(), false, [&](Row g) {
        if (held(model, g) || of_points[g] <= 0) return 0.0;
        return rows.gridpoint(g, points.zone_frequency[g] * (points.mass[g] / of_points[g]));
    });
    take_larger(limit, largest(blocks.size(), true, [&](Row b) { return blocks.body[b] == 0 ? rows.block(b) : 0; }));
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i)
        take_larger(limit, {rows.body(i), true, adjacency.bodies.members(i).front()});
    if (masses == Masses::real || model.settings.mass_scaling == MassScaling::none) return limit;

    const BodyStiffness stiffness = body_stiffness(model, adjacency);
    const auto ratio = [](double k, double mass) { return k > 0 ? k / mass : 0; };
    StepLimit other = largest(points.size(), false, [&](Row g) { return ratio(stiffness.of_gridpoint[g], of_points[g]); });
    take_larger(other, largest(blocks.size(), true,
                               [&](Row b) { return ratio(stiffness.of_block[b], blocks.inertial_mass[b]); }));
    return other.frequency_squared < limit.frequency_squared ? other : limit;
}

// The same theorem on the matrix M^-1 K itself, rotations measured by the radius of gyration: its rows are sums
// of stiffnesses that do not know of the neighbours' masses, over the body's own mass.
BodyStiffness body_stiffness(const Model& model, const Adjacency& adjacency) {
    const RowSums rows(model, adjacency, Masses::unit);
    const auto& points = model.gridpoints;
    const auto& blocks = model.blocks;
    BodyStiffness stiffness{std::vector<double>(points.size(), 0), std::vector<double>(blocks.size(), 0)};
    for_chunks(points.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row g = static_cast<Row>(i);
            if (!held(model, g)) stiffness.of_gridpoint[g] = rows.gridpoint(g, points.zone_frequency[g] * points.mass[g]);
        }
    });
    for_chunks(blocks.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (blocks.body[i] == 0) stiffness.of_block[i] = rows.block(static_cast<Row>(i));
    });
    // Members share the stiffness of their body by mass, so that one factor scales them all.
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        const auto members = adjacency.bodies.members(i);
        const double whole = rows.body(i);
        double mass = 0;
        for (const Row b : members) mass += blocks.mass[b];
        if (mass > 0)
            for (const Row b : members) stiffness.of_block[b] = whole * (blocks.mass[b] / mass);
    }
    return stiffness;
}

} // namespace kaya
