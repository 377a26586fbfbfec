#include "mechanics/structures/keep_forces.hpp"

#include "mechanics/structures/member_lists.hpp"
#include "model/structures/members.hpp"

namespace kaya {

namespace {

/// The part of a force that does not follow the deformation, after the stiffness of the other part has become `ratio` times as large.
void keep(double& kept, double force, double ratio) { kept = force - ratio * (force - kept); }

/// 1 where there was no stiffness, and so no force of it.
double ratio_of(double now, double before) { return before > 0 ? now / before : 1; }

void keep_cable(Model& model, const Span& span, const StructureProperties& before, const StructureProperties& now) {
    auto& nodes = model.structures.cable_nodes;
    const double bar_ratio = ratio_of(now.axial_stiffness(), before.axial_stiffness());
    const bool grout = before.grout_stiffness > 0 && now.grout_stiffness > 0;
    for (Row node = span.first; node < span.end(); ++node) {
        if (bar_ratio != 1) keep(nodes.bar_kept[node], nodes.bar_force[node], bar_ratio);
        if (!grout || nodes.anchored[node] || before.grout_stiffness == now.grout_stiffness) continue;
        const double elastic = nodes.slip[node] - nodes.slip_lost[node];
        nodes.slip_lost[node] = nodes.slip[node] - elastic * before.grout_stiffness / now.grout_stiffness;
    }
}

void keep_beam(BeamElements& beams, Row row, const BeamSection& before, const BeamSection& now) {
    auto& kept = beams.kept[row];
    const auto change = [&](std::size_t at, double force, double ratio) {
        if (ratio != 1) keep(kept[at], force, ratio);
    };
    change(0, beams.axial[row], ratio_of(now.axial, before.axial));
    change(1, beams.torsion[row], ratio_of(now.torsion, before.torsion));
    const double about_y = ratio_of(now.bending_y, before.bending_y),
                 about_z = ratio_of(now.bending_z, before.bending_z);
    for (std::size_t k = 0; k < 4; ++k) change(2 + k, beams.moments[row][k], k < 2 ? about_y : about_z);
}

void keep_liner(Model& model, Row row, const ShellSection& before, const ShellSection& now) {
    auto& liners = model.structures.liners;
    const auto& nodes = model.structures.member_nodes;
    std::array<Vec3, 3> corners;
    std::array<NodePose, 3> poses;
    for (std::size_t k = 0; k < 3; ++k) {
        const Row node = liners.nodes[row][k];
        corners[k] = nodes.reference[node];
        poses[k] = pose_of(nodes, node);
    }
    const ShellShape shape(corners, before);
    const ShellMotion motion = shell_motion(shape, poses);
    liners.kept[row] += shell_resultants(shape, motion) - shell_resultants(ShellShape(corners, now), motion);
}

/// The link has the force of now at the present distance from the rock. A bond that has opened keeps its gap.
void keep_link(Model& model, Row node, const LinkStiffness& now) {
    auto& nodes = model.structures.member_nodes;
    if (hold_of(model, node) != Hold::springs) return;
    const Mat3 turn = pose_of(nodes, node).turn;
    const Vec3& normal = nodes.normal[node];
    const Vec3 apart = turn.transpose() * (nodes.position[node] - nodes.rock[node]),
               force = turn.transpose() * nodes.rock_force[node];
    const double across = force.dot(normal);
    Vec3 slip = apart;
    if (across == 0) slip -= (apart - nodes.link_slip[node]).dot(normal) * normal;
    else if (now.normal > 0) slip -= across / now.normal * normal;
    if (now.shear > 0) slip -= (force - across * normal) / now.shear;
    nodes.link_slip[node] = slip;
}

} // namespace

void keep_structure_forces(Model& model, std::int32_t number, const StructureProperties& before) {
    auto& structures = model.structures;
    const StructureProperties& now = structures.properties.at(number);
    const auto& cables = structures.cables;
    for (Row cable = 0; cable < static_cast<Row>(cables.size()); ++cable)
        if (cables.property[cable] == number) keep_cable(model, cables.nodes[cable], before, now);
    const auto& members = structures.members;
    const BeamSection beam_before = section_of_beam(before), beam_now = section_of_beam(now);
    const ShellSection liner_before = section_of_liner(before), liner_now = section_of_liner(now);
    const bool liner_changes = liner_before != liner_now && liner_before.thickness * liner_before.young > 0;
    const bool link_changes = before.link_normal != now.link_normal || before.link_shear != now.link_shear;
    for (Row member = 0; member < static_cast<Row>(members.size()); ++member) {
        if (members.property[member] != number) continue;
        const Span &beams = members.beams[member], &liners = members.liners[member], &nodes = members.nodes[member];
        for (Row row = beams.first; row < beams.end(); ++row) keep_beam(structures.beams, row, beam_before, beam_now);
        if (liner_changes)
            for (Row row = liners.first; row < liners.end(); ++row) keep_liner(model, row, liner_before, liner_now);
        if (link_changes)
            for (Row node = nodes.first; node < nodes.end(); ++node)
                keep_link(model, node, link_stiffness(model, node, hold_of(model, node)));
    }
}

} // namespace kaya
