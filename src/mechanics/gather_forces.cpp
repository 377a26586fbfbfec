#include "base/reduce.hpp"
#include "mechanics/eight.hpp"
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
    double inner_power = 0; ///< of the forces of joints and zones

    void add(const Vec3& force, double acting) { add(force.norm(), acting); }
    void add(double size, double acting) {
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
void add_body(const Model& model, const Adjacency& adjacency, const JointForces& joints, std::span<const Row> members,
              Balance& balance) {
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
        if (adjacency.has_structures())
            for (auto e = adjacency.nodes_of_block.begin(row); e != adjacency.nodes_of_block.end(row); ++e)
                acting += force_of_node(model, e->node).force.norm();
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

    /// In the first three the sum of all forces but load and weight; the last is `acting` and the sizes of them all.
    Four sum_of(Row row, double acting) const {
        Four sum{0, 0, 0, acting};
        for (auto p = tiles.points_of.begin(row); p != tiles.points_of.end(row); ++p)
            sum += load_as<Four>(zone_forces[*p].value.data());
        const auto add = [&](double factor, const Vec3& v) {
            const double x = factor * v.x(), y = factor * v.y(), z = factor * v.z();
            sum += Four{x, y, z, std::sqrt(x * x + y * y + z * z)};
        };
        for (auto e = adjacency.of_gridpoint.begin(row); e != adjacency.of_gridpoint.end(row); ++e)
            add(e->side == 0 ? -e->weight : e->weight, joints.of_sub_contact[e->sub_contact]);
        for (const auto& share : ties.shares(row))
            add(share.weight, model.ties.force[share.tie] + model.ties.dashpot[share.tie]);
        if (adjacency.has_structures())
            for (auto e = adjacency.nodes_of_gridpoint.begin(row); e != adjacency.nodes_of_gridpoint.end(row); ++e)
                add(e->weight, force_of_node(model, e->node).force);
        return sum;
    }
    /// Whether each of rows [row, row + 8) is one point of one tile, and nothing else acts there.
    bool have_one_point_each(Row row) const {
        const Row *const points = &tiles.points_of.start[row], *const joined = &adjacency.of_gridpoint.start[row];
        bool each = joined[0] == joined[8] && !ties.any_shares() && !adjacency.has_structures();
        for (Row l = 0; l < eight; ++l) each &= points[l + 1] - points[l] == 1;
        return each;
    }
    Vec3 sum(Row row, double& acting) const {
        const Four sum = sum_of(row, acting);
        acting = sum[3] + (model.gridpoints.load[row].norm() + weight(row).norm());
        return {sum[0], sum[1], sum[2]};
    }
    Vec3 weight(Row row) const { return model.gridpoints.mass[row] * model.settings.gravity; }
};

/// What is out of balance on a point; `force` is the sum of all forces.
void add_point(const Vec3& force, std::uint8_t fixed, const Roller& roller, double acting, Balance& balance) {
    if ((fixed & 7) == 7) return;
    balance.add(free_part(force, fixed, roller), acting);
}

/// Eight gridpoints that follow each other, none of them held.
void gather_eight(Model& model, const PointForces& forces, Row row, Balance& balance) {
    auto& g = model.gridpoints;
    std::array<Four, 8> rows;
    if (forces.have_one_point_each(row)) {
        const Row* const points = forces.tiles.points_of.begin(row);
        for (Row l = 0; l < eight; ++l)
            rows[static_cast<std::size_t>(l)] = Four{} + load_as<Four>(forces.zone_forces[points[l]].value.data());
    } else {
        for (Row l = 0; l < eight; ++l) rows[static_cast<std::size_t>(l)] = forces.sum_of(row + l, 0);
    }
    for (Row l = 0; l < eight; ++l) {
        const Four& force = rows[static_cast<std::size_t>(l)];
        g.force[row + l] = Vec3(force[0], force[1], force[2]);
    }
    const std::array<Eight, 4> columns = columns_of_rows(rows);
    const Eight3 force{columns[0], columns[1], columns[2]};
    const Eight3 load = columns_of(load_three(g.load[row].data())),
                 velocity = columns_of(load_three(g.velocity[row].data()));
    const Vec3& gravity = model.settings.gravity;
    const Eight mass = load_as<Eight>(&g.mass[row]);
    const Eight3 weight{mass * gravity.x(), mass * gravity.y(), mass * gravity.z()};
    const Eight acting = columns[3] + (square_root(load.dot(load)) + square_root(weight.dot(weight)));
    const Eight3 whole = force + load + weight;
    const Eight size = square_root(whole.dot(whole)), power = force.dot(velocity);
    for (Row l = 0; l < eight; ++l) { // row after row: the sums are the same as one by one
        balance.inner_power += power[l];
        balance.add(size[l], acting[l]);
    }
}

/// Whether rows [row, row + 8) are free gridpoints of zones.
bool are_plain(const Model& model, const TieLists& ties, std::size_t row) {
    const auto& g = model.gridpoints;
    bool free = all_in_zones(model, row);
    for (std::size_t l = row; l < row + 8; ++l) free &= g.fixed[l] == 0 && g.roller[l] == 0;
    for (std::size_t l = row; free && l < row + 8; ++l) free = !ties.in_group(static_cast<Row>(l));
    return free;
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

/// Nodes of beams and liners that move by themselves; their forces are summed up already.
Balance balance_of_members(const Model& model, const MemberLists& members) {
    const auto& nodes = model.structures.member_nodes;
    return reduce_chunks(
        members.holds.size(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                const Hold hold = members.holds[i];
                if (hold == Hold::clamped) continue;
                part.inner_power += nodes.moment[i].dot(nodes.spin[i]);
                if (hold == Hold::pinned) continue;
                part.inner_power += nodes.force[i].dot(nodes.velocity[i]);
                const Row node = static_cast<Row>(i);
                double acting = nodes.rock_force[i].norm() + nodes.mass[i] * model.settings.gravity.norm();
                for (auto end = members.ends_of_node.begin(node); end != members.ends_of_node.end(node); ++end)
                    acting += members.ends[static_cast<std::size_t>(*end)].force.norm();
                part.add(nodes.force[i], acting);
            }
            return part;
        },
        combine);
}

} // namespace

double gather_forces(Model& model, const Adjacency& adjacency, const TieLists& ties, const JointForces& joints,
                     const ZoneTiles& tiles, const std::vector<PointRow>& zone_forces, const MemberLists& members) {
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
                if (const Row b = g.block[row]; !blocks.deformable[b]) {
                    i = static_cast<std::size_t>(blocks.gridpoints[b].end()) - 1;
                    continue;
                }
                if (last - i >= eight && are_plain(model, ties, i)) {
                    gather_eight(model, forces, row, part);
                    i += eight - 1;
                    continue;
                }
                if (ties.in_group(row)) continue;
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
                    for (Row p = blocks.gridpoints[row].first; p < blocks.gridpoints[row].end(); ++p) sum += g.force[p];
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
                if (adjacency.has_structures())
                    for (auto e = adjacency.nodes_of_block.begin(row); e != adjacency.nodes_of_block.end(row); ++e) {
                        const NodeForce node = force_of_node(model, e->node);
                        sum += node.force;
                        moment += (node.place - blocks.centroid[row]).cross(node.force) + node.moment;
                        acting += node.force.norm();
                    }
                blocks.force[row] = sum;
                blocks.moment[row] = moment;
                part.inner_power += sum.dot(blocks.velocity[row]) + moment.dot(blocks.rotational_velocity[row]);
                const Vec3 weight = blocks.mass[row] * gravity;
                if ((blocks.fixed[row] & 7) != 7 && blocks.body[row] == 0)
                    part.add(free_part(sum + blocks.load[row] + weight, blocks.fixed[row], roller_of(model, row)),
                             acting + blocks.load[row].norm() + weight.norm());
            }
            return part;
        },
        combine);
    combine(balance, of_blocks);
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i)
        add_body(model, adjacency, joints, adjacency.bodies.members(i), balance);

    if (members.any()) combine(balance, balance_of_members(model, members));

    Clock& clock = model.clock;
    clock.unbalanced_force = balance.largest;
    clock.average_ratio = balance.applied > 0 ? balance.unbalanced / balance.applied : 0;
    clock.maximum_ratio =
        balance.applied > 0 ? balance.largest * static_cast<double>(balance.bodies) / balance.applied : 0;
    clock.local_ratio = balance.local_ratio;
    return balance.inner_power;
}

} // namespace kaya
