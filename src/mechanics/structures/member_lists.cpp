#include "mechanics/structures/member_lists.hpp"

#include "base/parallel.hpp"
#include "model/measure/turn.hpp"
#include "model/structures/members.hpp"

#include <algorithm>

namespace kaya {

namespace {

constexpr std::size_t grain = 64;

const StructureProperties& properties_of(const Model& model, Row member) {
    return model.structures.properties.at(model.structures.members.property[member]);
}

template <std::size_t count>
std::array<Vec3, count> places_of(const Model& model, const std::array<Row, count>& nodes) {
    std::array<Vec3, count> places;
    for (std::size_t k = 0; k < count; ++k) places[k] = model.structures.member_nodes.reference[nodes[k]];
    return places;
}

} // namespace

NodePose pose_of(const MemberNodes& nodes, Row node) {
    return {nodes.position[node], quaternion(nodes.rotation[node]).toRotationMatrix()};
}

BeamSection section_of_beam(const StructureProperties& p) {
    const double shear = 0.5 * p.young / (1 + p.poisson);
    const double torsion =
        p.torsion_constant < p.unlimited ? p.torsion_constant : p.moment_of_area_y + p.moment_of_area_z;
    return {.axial = p.axial_stiffness(),
            .bending_y = p.young * p.moment_of_area_y,
            .bending_z = p.young * p.moment_of_area_z,
            .torsion = shear * torsion,
            .yield_tension = p.yield_tension,
            .yield_compression = p.yield_compression,
            .plastic_y = p.plastic_moment_y,
            .plastic_z = p.plastic_moment_z};
}

ShellSection section_of_liner(const StructureProperties& p) {
    return {.thickness = p.thickness, .young = p.young, .poisson = p.poisson};
}

MemberLists::MemberLists(const Model& model) {
    const auto& structures = model.structures;
    beams.resize(structures.beams.size());
    for (std::size_t row = 0; row < beams.size(); ++row) {
        const auto places = places_of(model, structures.beams.nodes[row]);
        Beam& beam = beams[row];
        beam.section = section_of_beam(properties_of(model, structures.beams.member[row]));
        beam.length = (places[1] - places[0]).norm();
        const Vec3 x = (places[1] - places[0]) / beam.length, &y = structures.beams.axis_y[row];
        beam.axes << x, y, x.cross(y);
    }
    shells.reserve(structures.liners.size());
    for (std::size_t row = 0; row < structures.liners.size(); ++row)
        shells.emplace_back(places_of(model, structures.liners.nodes[row]),
                            section_of_liner(properties_of(model, structures.liners.member[row])));
    ends.resize(2 * beams.size() + 3 * shells.size());
    ends_of_node = sorted_lists<Row>(structures.member_nodes.size(), [&](auto add) {
        Row end = 0;
        for (const auto& nodes : structures.beams.nodes)
            for (const Row node : nodes) add(node, end++);
        for (const auto& nodes : structures.liners.nodes)
            for (const Row node : nodes) add(node, end++);
    });
    poses.resize(structures.member_nodes.size());
    holds.resize(structures.member_nodes.size());
    for (Row node = 0; node < static_cast<Row>(holds.size()); ++node)
        holds[static_cast<std::size_t>(node)] = hold_of(model, node);
}

void compute_member_masses(Model& model) {
    auto& structures = model.structures;
    auto& nodes = structures.member_nodes;
    if (nodes.empty()) return;
    const MemberLists lists(model);
    std::vector<EndStiffness> of_element(lists.beams.size() + lists.shells.size());
    for_chunks(of_element.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            of_element[i] = i < lists.beams.size() ? beam_end_stiffness(lists.beams[i].section, lists.beams[i].length)
                                                   : shell_end_stiffness(lists.shells[i - lists.beams.size()]);
    });
    for (auto* column : {&nodes.mass, &nodes.stiffness, &nodes.rotation_stiffness})
        std::fill(column->begin(), column->end(), 0.0);
    const auto add = [&](std::size_t element, Row node, double mass) {
        nodes.mass[node] += mass;
        nodes.stiffness[node] += of_element[element].translation;
        nodes.rotation_stiffness[node] += of_element[element].rotation;
    };
    for (std::size_t row = 0; row < lists.beams.size(); ++row) {
        const StructureProperties& p = properties_of(model, structures.beams.member[row]);
        for (const Row node : structures.beams.nodes[row])
            add(row, node, 0.5 * p.density * p.area * lists.beams[row].length);
    }
    for (std::size_t row = 0; row < lists.shells.size(); ++row) {
        const StructureProperties& p = properties_of(model, structures.liners.member[row]);
        for (const Row node : structures.liners.nodes[row])
            add(lists.beams.size() + row, node, p.density * p.thickness * lists.shells[row].area / 3);
    }
}

MemberLimit member_limit(const Model& model) {
    const auto& nodes = model.structures.member_nodes;
    MemberLimit limit;
    for (Row node = 0; node < static_cast<Row>(nodes.size()); ++node) {
        const Hold hold = hold_of(model, node);
        if (hold == Hold::pinned || hold == Hold::clamped) continue;
        const double stiffness = node_resistance(model, node, hold);
        if (!(stiffness > 0)) continue;
        const double stable = 2 * std::sqrt(nodes.mass[node] / stiffness);
        if (stable < limit.stable) limit = {stable, node};
    }
    return limit;
}

double node_resistance(const Model& model, Row node, Hold hold) {
    const auto& nodes = model.structures.member_nodes;
    const LinkStiffness link = link_stiffness(model, node, hold);
    return nodes.stiffness[node] + 2 * std::max(link.normal, link.shear);
}

LinkStiffness link_stiffness(const Model& model, Row node, Hold hold) {
    if (hold != Hold::springs) return {};
    const auto& nodes = model.structures.member_nodes;
    const StructureProperties& p = properties_of(model, nodes.member[node]);
    return {p.link_normal * nodes.share[node], p.link_shear * nodes.share[node]};
}

bool member_masses_follow(const Settings& settings) {
    if (settings.mass_scaling != MassScaling::none) return true;
    return !settings.dynamic && settings.damping != Damping::none && settings.damping != Damping::rayleigh;
}

} // namespace kaya
