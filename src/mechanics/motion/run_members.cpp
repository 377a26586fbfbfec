#include "mechanics/motion/run_members.hpp"

#include "base/reduce.hpp"
#include "mechanics/motion/motion.hpp"
#include "mechanics/structures/rock_motion.hpp"
#include "mechanics/lanes/rotation.hpp"
#include "model/measure/measure.hpp"
#include "model/structures/members.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {

namespace {

constexpr std::size_t grain = 128;

void combine(MotionSums& sum, const MotionSums& part) { sum.add(part); }

bool moves_by_itself(Hold hold) { return hold == Hold::none || hold == Hold::springs; }

Quaternion plain(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

void turn_by(Quaternion& rotation, const Vec3& angle) {
    const double size = angle.norm();
    if (size == 0) return;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(size, angle / size));
    rotation = plain((turn * quaternion(rotation)).normalized());
}

/// Updates the rock point of a node.
void take_rock_point(Model& model, Row node, Hold hold, double step) {
    auto& nodes = model.structures.member_nodes;
    Vec3& rock = nodes.rock[node];
    rock = hold == Hold::none ? nodes.position[node]
                              : follow_rock(model, nodes, node, rock, step) + nodes.rock_shift[node];
}

/// Nodes without springs move with the rock. A pinned node turns freely.
void take_motion_of_rock(Model& model, Row node, Hold hold, double step) {
    auto& nodes = model.structures.member_nodes;
    const Vec3 shift = nodes.rock[node] - nodes.position[node];
    nodes.position[node] = nodes.rock[node];
    nodes.displacement[node] += shift;
    if (step > 0) nodes.velocity[node] = shift / step;
    if (hold != Hold::clamped) return;
    const Row block = rock_block(model, nodes, node);
    nodes.spin[node] = model.blocks.rotational_velocity[block];
    if (model.settings.large_strain)
        nodes.rotation[node] = plain(quaternion(model.blocks.orientation[block]) * quaternion(nodes.rock_turn[node]));
    else turn_by(nodes.rotation[node], step * nodes.spin[node]);
}

std::uint8_t next_state(std::uint8_t before, bool now) {
    const auto kept = static_cast<std::uint8_t>(before & (has_yielded | broken));
    return now ? static_cast<std::uint8_t>(kept | yields | has_yielded) : kept;
}

void run_beam(Model& model, MemberLists& lists, std::size_t row) {
    auto& beams = model.structures.beams;
    const auto& [section, axes, length] = lists.beams[row];
    const auto& nodes = beams.nodes[row];
    const BeamMotion motion = beam_motion(axes, length, lists.poses[static_cast<std::size_t>(nodes[0])],
                                          lists.poses[static_cast<std::size_t>(nodes[1])]);
    BeamLoss loss{beams.extension_lost[row], beams.hinges[row]};
    const BeamForces forces = beam_forces(section, length, motion, loss, beams.kept[row]);
    beams.extension_lost[row] = loss.extension;
    beams.hinges[row] = loss.hinge;
    beams.axial[row] = forces.axial;
    beams.torsion[row] = forces.torsion;
    beams.shear[row] = {forces.shear_y, forces.shear_z};
    beams.moments[row] = forces.moment;
    beams.state[row] = next_state(beams.state[row], forces.stretches || forces.hinges);
    const auto ends = beam_ends(motion, forces);
    std::ranges::copy(ends, lists.ends.begin() + static_cast<std::ptrdiff_t>(2 * row));
}

/// A symmetric plane tensor in rotated axes: xx, yy, xy.
Vec3 turned(const Vec3& value, double c, double s) {
    const double xx = c * c * value[0] + s * s * value[1] + 2 * c * s * value[2];
    return {xx, value[0] + value[1] - xx, c * s * (value[1] - value[0]) + (c * c - s * s) * value[2]};
}

void run_shell(Model& model, MemberLists& lists, std::size_t row) {
    auto& liners = model.structures.liners;
    const ShellShape& shape = lists.shells[row];
    std::array<NodePose, 3> poses;
    for (std::size_t k = 0; k < 3; ++k) poses[k] = lists.poses[static_cast<std::size_t>(liners.nodes[row][k])];
    const ShellForces forces = shell_forces(shape, poses, liners.kept[row]);
    liners.normal[row] = forces.axes.col(2);
    liners.axis[row] = liner_axis(model.structures.members.axis[liners.member[row]], forces.axes.col(2));
    const double c = liners.axis[row].dot(forces.axes.col(0)), s = liners.axis[row].dot(forces.axes.col(1));
    liners.membrane[row] = turned(forces.membrane, c, s);
    liners.moment[row] = turned(forces.moment, c, s);
    std::ranges::copy(forces.ends, lists.ends.begin() + static_cast<std::ptrdiff_t>(2 * lists.beams.size() + 3 * row));
}

/// Force of the link on its node. A bond broken in tension is lost: only pressure and friction remain.
Vec3 link_force(Model& model, Row node, const Mat3& turn) {
    auto& nodes = model.structures.member_nodes;
    const StructureProperties& p =
        model.structures.properties.at(model.structures.members.property[nodes.member[node]]);
    const double share = nodes.share[node];
    const Vec3& normal = nodes.normal[node];
    const Vec3 stretch = turn.transpose() * (nodes.position[node] - nodes.rock[node]) - nodes.link_slip[node];
    const double opening = stretch.dot(normal);
    double across = p.link_normal * share * opening; // tension
    std::uint8_t& state = nodes.link_state[node];
    if (across > p.link_tension * share) state |= broken;
    if ((state & broken) && across > 0) across = 0;
    const Vec3 along = stretch - opening * normal;
    const double stiffness = p.link_shear * share;
    Vec3 shear = stiffness * along;
    const bool bonded = !(state & broken);
    const double friction = p.link_friction > 0 ? std::tan(p.link_friction * std::numbers::pi / 180) : 0;
    const double strength = (bonded ? p.link_cohesion * share : 0) + friction * std::max(0.0, -across);
    const double size = shear.norm();
    const bool slips = size > strength;
    if (slips) {
        shear *= strength / size;
        if (stiffness > 0) nodes.link_slip[node] += along - shear / stiffness;
    }
    state = next_state(state, slips);
    return -(turn * (across * normal + shear));
}

/// Sum of forces on a node. Returns the work of the node and the rock on the member in the step.
double run_node(Model& model, const MemberLists& lists, Row node, double step) {
    auto& nodes = model.structures.member_nodes;
    const Hold hold = lists.holds[static_cast<std::size_t>(node)];
    const NodePose& pose = lists.poses[static_cast<std::size_t>(node)];
    Vec3 force = nodes.mass[node] * model.settings.gravity, moment = Vec3::Zero();
    for (auto end = lists.ends_of_node.begin(node); end != lists.ends_of_node.end(node); ++end) {
        force += lists.ends[static_cast<std::size_t>(*end)].force;
        moment += lists.ends[static_cast<std::size_t>(*end)].moment;
    }
    Vec3 on_rock = Vec3::Zero(), turning_rock = Vec3::Zero();
    if (hold == Hold::springs) {
        const Vec3 link = link_force(model, node, pose.turn);
        on_rock = -link;
        force += link;
    } else if (hold != Hold::none) {
        on_rock = force;
        force = Vec3::Zero();
        if (hold == Hold::clamped) std::swap(turning_rock, moment);
    }
    // Work of springs, elements and weight on nodes and rock is taken from the member.
    const Vec3 shift = step * nodes.velocity[node], turn = step * nodes.spin[node];
    const Vec3 of_rock =
        hold == Hold::springs ? Vec3(step * rock_velocity(model, nodes, node, nodes.rock[node])) : shift;
    const double work =
        -0.5 * ((force + nodes.force[node]).dot(shift) + (moment + nodes.moment[node]).dot(turn) +
                (on_rock + nodes.rock_force[node]).dot(of_rock) + (turning_rock + nodes.rock_moment[node]).dot(turn));
    nodes.force[node] = force;
    nodes.moment[node] = moment;
    nodes.rock_force[node] = on_rock;
    nodes.rock_moment[node] = turning_rock;
    return work;
}

} // namespace

MotionSums move_members(Model& model, const MemberLists& lists) {
    auto& nodes = model.structures.member_nodes;
    const DampingFactors damping(model.settings, model.clock);
    const double kick = model.clock.kick(), step = model.clock.time_step;
    return reduce_chunks(
        nodes.size(), grain, MotionSums{},
        [&](std::size_t first, std::size_t last) {
            MotionLanes sums;
            const Vec3 none = Vec3::Zero();
            const Lanes no_weight = Lanes{}; // it is part of the force
            for (std::size_t i = first; i < last; ++i) {
                const Hold hold = lists.holds[i];
                if (hold == Hold::clamped) continue;
                advance_velocity(nodes.spin[i], nodes.moment[i], none, no_weight, nodes.inertia[i], kick, 0, damping,
                                 nodes.last_moment[i], sums);
                turn_by(nodes.rotation[i], step * nodes.spin[i]);
                if (!moves_by_itself(hold)) continue;
                advance_velocity(nodes.velocity[i], nodes.force[i], none, no_weight, nodes.inertial_mass[i], kick, 0,
                                 damping, nodes.last_force[i], sums);
                const Vec3 shift = step * nodes.velocity[i];
                nodes.position[i] += shift;
                nodes.displacement[i] += shift;
            }
            return sums.sums();
        },
        combine);
}

double run_members(Model& model, MemberLists& lists, double step) {
    auto& structures = model.structures;
    auto& nodes = structures.member_nodes;
    for_chunks(nodes.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Row node = static_cast<Row>(i);
            const Hold hold = lists.holds[i];
            take_rock_point(model, node, hold, step);
            if (!moves_by_itself(hold)) take_motion_of_rock(model, node, hold, step);
            lists.poses[i] = pose_of(nodes, node);
        }
    });
    for_chunks(lists.beams.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) run_beam(model, lists, row);
    });
    for_chunks(lists.shells.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) run_shell(model, lists, row);
    });
    return reduce_chunks(
        nodes.size(), grain, 0.0,
        [&](std::size_t first, std::size_t last) {
            double work = 0;
            for (std::size_t i = first; i < last; ++i) work += run_node(model, lists, static_cast<Row>(i), step);
            return work;
        },
        [](double& sum, double part) { sum += part; });
}

} // namespace kaya
