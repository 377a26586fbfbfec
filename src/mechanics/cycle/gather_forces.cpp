#include "base/reduce.hpp"
#include "mechanics/common/block_chunks.hpp"
#include "mechanics/lanes/eight.hpp"
#include "mechanics/supports/held_directions.hpp"
#include "mechanics/cycle/gather_forces.hpp"
#include "mechanics/motion/plain_rows.hpp"
#include "mechanics/ties/ties.hpp"
#include "model/measure/roller.hpp"
#include "model/structures/members.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {

namespace {

constexpr std::size_t grain = ForceGathering::grain;

void combine(Balance& sum, const Balance& part) {
    sum.largest = std::max(sum.largest, part.largest);
    sum.unbalanced += part.unbalanced;
    sum.applied += part.applied;
    sum.local_ratio = std::max(sum.local_ratio, part.local_ratio);
    sum.bodies += part.bodies;
    sum.inner_power += part.inner_power;
}

/// The free components, without those along held directions.
Vec3 free_part(Vec3 force, std::uint8_t fixed, const Roller& roller) {
    for (int k = 0; k < 3; ++k)
        if (fixed & (1 << k)) force[k] = 0;
    if (roller.count != 0) force += roller_change(roller, force, fixed, Vec3::Zero());
    return force;
}

/// Joined blocks count as one body with the sum of their forces.
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

/// Forces on gridpoints, and for each the sum of the magnitudes of all its forces.
class PointSums {
public:
    PointSums(const Model& model, const PointForces& forces) : model_(model), forces_(forces) {}

    /// The first three: the sum of all forces except load and weight; the last: `acting` plus the magnitudes of these forces.
    Four sum_of(Row row, double acting) const {
        const auto& [adjacency, ties, joints, tiles, zone_forces] = forces_;
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
            add(share.weight, model_.ties.force[share.tie] + model_.ties.dashpot[share.tie]);
        if (adjacency.has_structures())
            for (auto e = adjacency.nodes_of_gridpoint.begin(row); e != adjacency.nodes_of_gridpoint.end(row); ++e)
                add(e->weight, force_of_node(model_, e->node).force);
        return sum;
    }
    /// Whether each of rows [row, row + 8) is one point of one tile, with no other forces.
    bool have_one_point_each(Row row) const {
        const Row *const points = &forces_.tiles.points_of.start[row], *const joined =
                                                                           &forces_.adjacency.of_gridpoint.start[row];
        bool each = joined[0] == joined[8] && !forces_.ties.any_shares() && !forces_.adjacency.has_structures();
        for (Row l = 0; l < eight; ++l) each &= points[l + 1] - points[l] == 1;
        return each;
    }
    Vec3 sum(Row row, double& acting) const {
        const Four sum = sum_of(row, acting);
        acting = sum[3] + (model_.gridpoints.load[row].norm() + weight(row).norm());
        return {sum[0], sum[1], sum[2]};
    }
    Vec3 weight(Row row) const { return model_.gridpoints.mass[row] * model_.settings.gravity; }
    const PointForces& forces() const { return forces_; }

private:
    const Model& model_;
    const PointForces& forces_;
};

/// Adds the unbalanced force of a point; `force` is the sum of all forces.
void add_point(const Vec3& force, std::uint8_t fixed, const Roller& roller, double acting, Balance& balance) {
    if ((fixed & 7) == 7) return;
    balance.add(free_part(force, fixed, roller), acting);
}

/// Maxima that Balance needs, lane by lane.
struct Extremes {
    Eight largest{}, local_ratio{};

    void add(const Eight& size, const Eight& acting) {
        const Eight ratio = acting > 0 ? size / acting : Eight{};
        largest = size > largest ? size : largest;
        local_ratio = ratio > local_ratio ? ratio : local_ratio;
    }
    void add_to(Balance& balance) const {
        balance.largest = std::max(balance.largest, kaya::largest(largest));
        balance.local_ratio = std::max(balance.local_ratio, kaya::largest(local_ratio));
    }
};

Eight size_of(const Eight3& vector) { return square_root(vector.dot(vector)); }

/// Free components of eight vectors; 1 for rows with a free component, else 0.
struct FreePart {
    Eight3 vector;
    Eight some;
};
FreePart free_part(const Eight3& force, const std::uint8_t* fixed) {
    MaskOfEight bits{};
    for (std::size_t l = 0; l < 8; ++l) bits[l] = fixed[l] & 7;
    const Eight none{};
    return {{(bits & 1) != 0 ? none : force.x, (bits & 2) != 0 ? none : force.y, (bits & 4) != 0 ? none : force.z},
            bits == 7 ? none : eights(1)};
}

/// Eight consecutive gridpoints held by fixities only.
void gather_eight(Model& model, const PointSums& sums, Row row, Balance& balance, Extremes& extremes) {
    auto& g = model.gridpoints;
    std::array<Four, 8> rows;
    if (sums.have_one_point_each(row)) {
        const PointForces& forces = sums.forces();
        const Row* const points = forces.tiles.points_of.begin(row);
        for (Row l = 0; l < eight; ++l)
            rows[static_cast<std::size_t>(l)] = Four{} + load_as<Four>(forces.zone_forces[points[l]].value.data());
    } else {
        for (Row l = 0; l < eight; ++l) rows[static_cast<std::size_t>(l)] = sums.sum_of(row + l, 0);
    }
    const std::array<Eight, 4> columns = columns_of_rows(rows);
    const Eight3 force{columns[0], columns[1], columns[2]};
    store(g.force[row].data(), three_of(force));
    const ThreeEights loads = load_three(g.load[row].data());
    const Eight3 load = columns_of(loads), velocity = columns_of(load_three(g.velocity[row].data()));
    const Vec3& gravity = model.settings.gravity;
    const Eight mass = load_as<Eight>(&g.mass[row]);
    const Eight3 weight{mass * gravity.x(), mass * gravity.y(), mass * gravity.z()};
    const bool loaded = !(all_zero(loads[0]) && all_zero(loads[1]) && all_zero(loads[2]));
    Eight acting = columns[3] + ((loaded ? size_of(load) : Eight{}) + size_of(weight));
    Eight3 unbalanced = force + load + weight;
    balance.bodies += eight;
    if (!all_zero_rows(&g.fixed[row])) {
        const FreePart free = free_part(unbalanced, &g.fixed[row]);
        unbalanced = free.vector;
        acting = free.some != 0 ? acting : Eight{};
        balance.bodies -= static_cast<std::size_t>(eight - sum(free.some));
    }
    const Eight size = size_of(unbalanced);
    extremes.add(size, acting);
    // Row after row: the sums are the same as one by one.
    Four whole{balance.unbalanced, balance.applied, balance.inner_power, 0};
    for (const Four& one : rows_of_columns({size, acting, force.dot(velocity), Eight{}})) whole += one;
    balance.unbalanced = whole[0];
    balance.applied = whole[1];
    balance.inner_power = whole[2];
}

/// Tied gridpoints count as one.
Balance gather_groups(Model& model, const PointForces& forces) {
    auto& g = model.gridpoints;
    const auto& ties = forces.ties;
    const PointSums sums(model, forces);
    return reduce_chunks(
        ties.groups(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                Vec3 sum = Vec3::Zero();
                double acting = 0;
                std::uint8_t fixed = 0;
                for (const Row row : ties.members(i)) {
                    g.force[row] = sums.sum(row, acting);
                    sum += g.force[row] + g.load[row] + sums.weight(row);
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

/// Free nodes of beams and liners; their forces are already summed.
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

/// The force on a block with zones.
void sum_gridpoints(Model& model, Row block) {
    Vec3 sum = Vec3::Zero();
    const Span points = model.blocks.gridpoints[block];
    for (Row p = points.first; p < points.end(); ++p) sum += model.gridpoints.force[p];
    model.blocks.force[block] = sum;
}

/// Force and moment on a rigid block.
void gather_rigid(Model& model, const Adjacency& adjacency, const JointForces& joints, Row row, Balance& balance) {
    auto& blocks = model.blocks;
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double acting = 0;
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
    balance.inner_power += sum.dot(blocks.velocity[row]) + moment.dot(blocks.rotational_velocity[row]);
    const Vec3 weight = blocks.mass[row] * model.settings.gravity;
    if ((blocks.fixed[row] & 7) != 7 && blocks.body[row] == 0)
        balance.add(free_part(sum + blocks.load[row] + weight, blocks.fixed[row], roller_of(model, row)),
                    acting + blocks.load[row].norm() + weight.norm());
}

/// Forces and moments on blocks. Forces on gridpoints are known, and so are the sums of blocks that lie within one chunk.
Balance gather_blocks(Model& model, const PointForces& forces) {
    auto& blocks = model.blocks;
    return reduce_chunks(
        blocks.size(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            Balance part;
            for (std::size_t i = first; i < last; ++i) {
                const Row row = static_cast<Row>(i);
                if (!blocks.deformable[row]) gather_rigid(model, forces.adjacency, forces.joints, row, part);
                else if (forces.ties.groups() != 0 || !in_one_chunk(blocks.gridpoints[row], grain))
                    sum_gridpoints(model, row);
            }
            return part;
        },
        combine);
}

} // namespace

bool ForceGathering::only_zones_act(std::size_t first, std::size_t last) const {
    const auto& joined = forces_.adjacency.of_gridpoint.start;
    return joined[first] == joined[last] && forces_.ties.groups() == 0 && !forces_.ties.any_shares() &&
           !forces_.adjacency.has_structures();
}

Balance ForceGathering::gather(std::size_t first, std::size_t last) {
    auto& g = model_.gridpoints;
    const TieLists& ties = forces_.ties;
    const PointSums sums(model_, forces_);
    Balance part;
    Extremes extremes;
    for (std::size_t i = first; i < last; ++i) {
        const Row row = static_cast<Row>(i);
        if (const Row b = g.block[row]; !model_.blocks.deformable[b]) {
            i = static_cast<std::size_t>(model_.blocks.gridpoints[b].end()) - 1;
            continue;
        }
        if (last - i >= eight && are_plain(model_, ties, i)) {
            gather_eight(model_, sums, row, part, extremes);
            i += eight - 1;
            continue;
        }
        if (ties.in_group(row)) continue;
        double acting = 0;
        g.force[row] = sums.sum(row, acting);
        part.inner_power += g.force[row].dot(g.velocity[row]);
        add_point(g.force[row] + g.load[row] + sums.weight(row), g.fixed[row],
                  model_.rollers[static_cast<std::size_t>(g.roller[row])], acting, part);
    }
    extremes.add_to(part);
    if (ties.groups() == 0) for_deformable_in(model_, first, last, [&](Row block) { sum_gridpoints(model_, block); });
    return part;
}

double gather_forces(Model& model, const PointForces& forces, const MemberLists& members,
                     const GatheredChunks& gathered) {
    const auto& [adjacency, ties, joints, tiles, zone_forces] = forces;
    ForceGathering points(model, forces);
    Balance balance = reduce_chunks(
        model.gridpoints.size(), grain, Balance{},
        [&](std::size_t first, std::size_t last) {
            const std::size_t chunk = first / grain;
            return !gathered.done.empty() && gathered.done[chunk] ? gathered.balance[chunk]
                                                                  : points.gather(first, last);
        },
        combine);
    combine(balance, gather_groups(model, forces));
    combine(balance, gather_blocks(model, forces));
    for (std::size_t i = 0; i < adjacency.bodies.size(); ++i)
        add_body(model, adjacency, joints, adjacency.bodies.members(i), balance);

    if (members.any()) combine(balance, balance_of_members(model, members));

    Clock& clock = model.clock;
    // Maxima leave out what is not a number, and sums keep it: equilibrium is not made of it.
    const bool finite = std::isfinite(balance.unbalanced) && std::isfinite(balance.applied);
    clock.unbalanced_force = finite ? balance.largest : std::numeric_limits<double>::quiet_NaN();
    clock.average_ratio = balance.applied > 0 ? balance.unbalanced / balance.applied : 0;
    clock.maximum_ratio =
        balance.applied > 0 ? balance.largest * static_cast<double>(balance.bodies) / balance.applied : 0;
    clock.local_ratio = balance.local_ratio;
    return balance.inner_power;
}

} // namespace kaya
