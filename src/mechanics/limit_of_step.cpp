#include "mechanics/phases.hpp"

#include "base/reduce.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 1024;

/// Size of a sub-contact's row at one of its nodes, in coordinates scaled by the roots of the masses:
/// w / sqrt(m) at a gridpoint, sqrt(1/m + r^2/I) at a rigid block with its least moment of inertia I.
class NodeSize {
public:
    NodeSize(const Model& model, const JoinedBodies& bodies)
        : model_(model), mass_(model.blocks.mass), centroid_(model.blocks.centroid),
          least_inertia_(model.blocks.size(), 0) {
        const auto& blocks = model.blocks;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            if (blocks.deformable[b] || blocks.mass[b] <= 0) continue;
            Eigen::SelfAdjointEigenSolver<Mat3> solver;
            solver.computeDirect(blocks.inertia[b], Eigen::EigenvaluesOnly);
            least_inertia_[b] = solver.eigenvalues()[0] * blocks.mass[b] / blocks.volume[b];
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const BodyMass body = body_mass(model, bodies.members(i));
            Eigen::SelfAdjointEigenSolver<Mat3> solver;
            solver.computeDirect(body.inertia, Eigen::EigenvaluesOnly);
            std::uint8_t fixed = 0;
            for (const Row b : bodies.members(i)) fixed |= blocks.fixed[b];
            for (const Row b : bodies.members(i)) {
                mass_[b] = fixed == fix_all ? 0 : body.mass;
                centroid_[b] = body.centroid;
                least_inertia_[b] = solver.eigenvalues()[0];
            }
        }
    }

    double gridpoint(Row g, double weight) const {
        if ((model_.gridpoints.fixed[g] & 7) == 7) return 0;
        return weight / std::sqrt(model_.gridpoints.mass[g]);
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
    std::vector<double> mass_; ///< of a joined block: of the whole body, like the two below; 0 when it is held
    std::vector<Vec3> centroid_;
    std::vector<double> least_inertia_;
};

void take_larger(StepLimit& limit, const StepLimit& other) {
    if (other.frequency_squared > limit.frequency_squared) limit = other;
}

} // namespace

// Gershgorin's theorem on the scaled stiffness matrix: a sub-contact of stiffness k couples its nodes i
// and j with at most k s_i s_j, s being the sizes above, so every eigenvalue is below the largest of
// sum over sub-contacts of k s_i (sum over its nodes of s_j), to which the zones add theirs.
StepLimit limit_of_step(const Model& model, const Adjacency& adjacency) {
    const auto& subs = model.sub_contacts;
    const NodeSize size(model, adjacency.bodies);
    std::vector<double> coupling(subs.size());
    for_chunks(subs.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row s = static_cast<Row>(i);
            const double stiffness = std::max(subs.normal_stiffness[s], subs.shear_stiffness[s]) * subs.area[s];
            const Row c = subs.contact[s];
            coupling[s] = stiffness * (size.side(model.contacts.block1[c], subs.side1[s], s) +
                                       size.side(model.contacts.block2[c], subs.side2[s], s));
        }
    });
    StepLimit limit = reduce_chunks(
        model.gridpoints.size(), grain, StepLimit{},
        [&](std::size_t first, std::size_t last) {
            StepLimit part;
            for (std::size_t i = first; i < last; ++i) {
                const Row row = static_cast<Row>(i);
                if ((model.gridpoints.fixed[row] & 7) == 7) continue;
                double sum = model.gridpoints.zone_frequency[row];
                for (auto e = adjacency.of_gridpoint.begin(row); e != adjacency.of_gridpoint.end(row); ++e)
                    sum += size.gridpoint(row, e->weight) * coupling[e->sub_contact];
                take_larger(part, {sum, false, row});
            }
            return part;
        },
        take_larger);
    const auto frequency_of = [&](Row row) {
        double sum = 0;
        for (auto e = adjacency.of_block.begin(row); e != adjacency.of_block.end(row); ++e) {
            const Span span = model.contacts.sub_contacts[e->contact];
            for (Row s = span.first; s < span.end(); ++s) sum += size.block(row, s) * coupling[s];
        }
        return sum;
    };
    const StepLimit of_blocks = reduce_chunks(
        model.blocks.size(), grain, StepLimit{},
        [&](std::size_t first, std::size_t last) {
            StepLimit part;
            for (std::size_t i = first; i < last; ++i) {
                const Row row = static_cast<Row>(i);
                if (model.blocks.body[row] == 0) take_larger(part, {frequency_of(row), true, row});
            }
            return part;
        },
        take_larger);
    take_larger(limit, of_blocks);
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i) {
        double sum = 0;
        for (const Row row : adjacency.bodies.members(i)) sum += frequency_of(row);
        take_larger(limit, {sum, true, adjacency.bodies.members(i).front()});
    }
    return limit;
}

} // namespace kaya
