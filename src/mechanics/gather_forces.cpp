#include "base/reduce.hpp"
#include "mechanics/held_directions.hpp"
#include "mechanics/gather_forces.hpp"
#include "mechanics/ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

constexpr std::size_t grain = 512;

/// Unbalanced forces of free bodies against the forces that act on them.
struct Balance {
    double largest = 0;     ///< unbalanced force of one body
    double unbalanced = 0;  ///< sum over bodies
    double applied = 0;     ///< sum over bodies of the sizes of all forces on them
    double local_ratio = 0; ///< largest unbalanced over applied of one body
    std::size_t bodies = 0;
    double inner_power = 0;  ///< of the forces of joints and zones

    void add(const Vec3& force, double acting) {
        const double size = force.norm();
        largest = std::max(largest, size);
        unbalanced += size;
        applied += acting;
        if (acting > 0) local_ratio = std::max(local_ratio, size / acting);
        ++bodies;
    }
};

void combine(Balance& sum, const Balance& part) {
    sum.largest = std::max(sum.largest, part.largest);
    sum.unbalanced += part.unbalanced;
    sum.applied += part.applied;
    sum.local_ratio = std::max(sum.local_ratio, part.local_ratio);
    sum.bodies += part.bodies;
    sum.inner_power += part.inner_power;
}

/// The components that may move, without those along directions that are held.
Vec3 free_part(Vec3 force, std::uint8_t fixed, const Roller& roller) {
    for (int k = 0; k < 3; ++k)
        if (fixed & (1 << k)) force[k] = 0;
    if (roller.count != 0) force += roller_change(roller, force, fixed, Vec3::Zero());
    return force;
}

/// Joined blocks count as one body, on which the forces of all of them act.
void add_body(const Model& model, const Adjacency& adjacency, const JointForces& joints,
              std::span<const Row> members, Balance& balance) {
    const auto& blocks = model.blocks;
    Vec3 force = Vec3::Zero();
    double acting = 0;
    std::uint8_t fixed = 0;
    for (const Row row : members) {
        const Vec3 weight = blocks.mass[row] * model.settings.gravity;
        force += blocks.force[row] + blocks.load[row] + weight;
        acting += blocks.load[row].norm() + weight.norm();
        for (auto e = adjacency.of_block.begin(row); e != adjacency.of_block.end(row); ++e)
            acting += joints.of_contact[e->contact].norm();
        if (adjacency.has_cables())
            for (auto e = adjacency.nodes_of_block.begin(row); e != adjacency.nodes_of_block.end(row); ++e)
                acting += model.structures.nodes.force[e->node].norm();
        fixed |= blocks.fixed[row];
    }
    if ((fixed & 7) != 7) balance.add(free_part(force, fixed, roller_of_body(model, members)), acting);
}

/// Forces on gridpoints, and the sum of the sizes of all that act on one.
struct PointForces {
    const Model& model;
    const Adjacency& adjacency;
    const TieLists& ties;
    const JointForces& joints;
    const ZoneTiles& tiles;
    const std::vector<PointRow>& zone_forces; ///< by point of the tiles

    Vec3 sum(Row row, double& acting) const {
        Vec3 sum = Vec3::Zero();
        const auto add = [&](const Vec3& force) {
            sum += force;
            acting += force.norm();
        };
        for (auto p = tiles.points_of.begin(row); p != tiles.points_of.end(row); ++p) {
            const auto& [x, y, z, size] = zone_forces[*p].value;
            sum += Vec3(x, y, z);
            acting += size;
        }
        for (auto e = adjacency.of_gridpoint.begin(row); e != adjacency.of_gridpoint.end(row); ++e)
            add((e->side == 0 ? -e->weight : e->weight) * joints.of_sub_contact[e->sub_contact]);
        for (const auto& share : ties.shares(row))
            add(share.weight * (model.ties.force[share.tie] + model.ties.dashpot[share.tie]));
        if (adjacency.has_cables())
            for (auto e = adjacency.nodes_of_gridpoint.begin(row); e != adjacency.nodes_of_gridpoint.end(row); ++e)
                add(e->weight * model.structures.nodes.force[e->node]);
        acting += model.gridpoints.load[row].norm() + weight(row).norm();
        return sum;
    }
    Vec3 weight(Row row) const { return model.gridpoints.mass[row] * model.settings.gravity; }
};

/// What is out of balance on a point; `force` is the sum of all forces.
void add_point(const Vec3& force, std::uint8_t fixed, const Roller& roller, double acting, Balance& balance) {
    if ((fixed & 7) == 7) return;
    balance.add(free_part(force, fixed, roller), acting);
}

/// Gridpoints that are tied to each other count as one.
Balance gather_groups(Model& model, const PointForces& forces) {
    auto& g = model.gridpoints;
    const auto& ties = forces.ties;
    return reduce_chunks(
        ties.groups(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                Vec3 sum = Vec3::Zero();
                double acting = 0;
                std::uint8_t fixed = 0;
                for (const Row row : ties.members(i)) {
                    g.force[row] = forces.sum(row, acting);
                    sum += g.force[row] + g.load[row] + forces.weight(row);
                    fixed |= g.fixed[row];
                }
                add_point(sum, fixed, ties.roller(i), acting, part);
                share_forces(model, ties.members(i));
                for (const Row row : ties.members(i)) part.inner_power += g.force[row].dot(g.velocity[row]);
            }
            return part;
        },
        combine);
}

} // namespace

double gather_forces(Model& model, const Adjacency& adjacency, const TieLists& ties, const JointForces& joints,
                     const ZoneTiles& tiles, const std::vector<PointRow>& zone_forces) {
    auto& g = model.gridpoints;
    auto& blocks = model.blocks;
    const Vec3 gravity = model.settings.gravity;
    const PointForces forces{model, adjacency, ties, joints, tiles, zone_forces};

    Balance balance = reduce_chunks(
        g.size(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                const Row row = static_cast<Row>(i);
                if (!blocks.deformable[g.block[row]] || ties.in_group(row)) continue;
                double acting = 0;
                g.force[row] = forces.sum(row, acting);
                part.inner_power += g.force[row].dot(g.velocity[row]);
                add_point(g.force[row] + g.load[row] + forces.weight(row), g.fixed[row],
                          model.rollers[static_cast<std::size_t>(g.roller[row])], acting, part);
            }
            return part;
        },
        combine);
    combine(balance, gather_groups(model, forces));

    const Balance of_blocks = reduce_chunks(
        blocks.size(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                const Row row = static_cast<Row>(i);
                Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
                double acting = 0;
                if (blocks.deformable[row]) {
                    for (Row p = blocks.gridpoints[row].first; p < blocks.gridpoints[row].end(); ++p)
                        sum += g.force[p];
                    blocks.force[row] = sum;
                    continue;
                }
                for (auto e = adjacency.of_block.begin(row); e != adjacency.of_block.end(row); ++e) {
                    const double sign = e->side == 0 ? -1.0 : 1.0;
                    const Vec3 force = sign * joints.of_contact[e->contact];
                    const Vec3 arm = model.contacts.position[e->contact] - blocks.centroid[row];
                    sum += force;
                    moment += arm.cross(force) + sign * joints.moment[e->contact];
                    acting += force.norm();
                }
                if (adjacency.has_cables())
                    for (auto e = adjacency.nodes_of_block.begin(row); e != adjacency.nodes_of_block.end(row); ++e) {
                        const Vec3& force = model.structures.nodes.force[e->node];
                        sum += force;
                        moment += (model.structures.nodes.position[e->node] - blocks.centroid[row]).cross(force);
                        acting += force.norm();
                    }
                blocks.force[row] = sum;
                blocks.moment[row] = moment;
                part.inner_power += sum.dot(blocks.velocity[row]) + moment.dot(blocks.rotational_velocity[row]);
                const Vec3 weight = blocks.mass[row] * gravity;
                if ((blocks.fixed[row] & 7) != 7 && blocks.body[row] == 0)
                    part.add(free_part(sum + blocks.load[row] + weight, blocks.fixed[row],
                                       roller_of(model, row)),
                             acting + blocks.load[row].norm() + weight.norm());
            }
            return part;
        },
        combine);
    combine(balance, of_blocks);
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i)
        add_body(model, adjacency, joints, adjacency.bodies.members(i), balance);

    Clock& clock = model.clock;
    clock.unbalanced_force = balance.largest;
    clock.average_ratio = balance.applied > 0 ? balance.unbalanced / balance.applied : 0;
    clock.maximum_ratio =
        balance.applied > 0 ? balance.largest * static_cast<double>(balance.bodies) / balance.applied : 0;
    clock.local_ratio = balance.local_ratio;
    return balance.inner_power;
}

} // namespace kaya
