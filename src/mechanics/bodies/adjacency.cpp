#include "mechanics/bodies/adjacency.hpp"

#include "mechanics/structures/member_lists.hpp"
#include "mechanics/bodies/run_cables.hpp"
#include "model/structures/members.hpp"

namespace kaya {

namespace {

/// The table of a node of a structure, and its row there.
struct HeldRow {
    const RockPoints& points;
    Row row;
};

HeldRow held_row(const Model& model, Row node) {
    const auto& structures = model.structures;
    const Row cables = static_cast<Row>(structures.cable_nodes.size());
    if (node < cables) return {structures.cable_nodes, node};
    return {structures.member_nodes, node - cables};
}

bool is_cable(const Model& model, Row node) { return node < static_cast<Row>(model.structures.cable_nodes.size()); }

NodeStiffness stiffness_of(const Model& model, Row node) {
    if (is_cable(model, node)) return cable_node_stiffness(model, node);
    const Row row = held_row(model, node).row;
    const auto& nodes = model.structures.member_nodes;
    const Hold hold = hold_of(model, row);
    const LinkStiffness link = link_stiffness(model, row, hold);
    if (hold == Hold::springs) return {2 * link.normal, 2 * link.shear, 0}; // the node moves too
    if (hold == Hold::none) return {};
    return {nodes.stiffness[row], nodes.stiffness[row], hold == Hold::clamped ? nodes.rotation_stiffness[row] : 0};
}

void list_nodes(const Model& model, Adjacency& adjacency) {
    const auto rows = static_cast<Row>(model.structures.cable_nodes.size() + model.structures.member_nodes.size());
    adjacency.nodes_of_block = sorted_lists<NodeEntry>(model.blocks.size(), [&](auto add) {
        for (Row node = 0; node < rows; ++node)
            if (const NodePlace at = place_of_held_node(model, node); at.block != no_row && at.corners == nullptr)
                add(at.block, NodeEntry{node, 1});
    });
    adjacency.nodes_of_gridpoint = sorted_lists<NodeEntry>(model.gridpoints.size(), [&](auto add) {
        for (Row node = 0; node < rows; ++node)
            if (const NodePlace at = place_of_held_node(model, node); at.corners != nullptr)
                for (std::size_t k = 0; k < 4; ++k)
                    if ((*at.weights)[k] != 0) add((*at.corners)[k], NodeEntry{node, (*at.weights)[k]});
    });
    for (Row node = 0; node < rows; ++node) adjacency.node_stiffness.push_back(stiffness_of(model, node));
}

} // namespace

NodePlace place_of_held_node(const Model& model, Row node) {
    const auto& [points, row] = held_row(model, node);
    const Row block = rock_block(model, points, row);
    if (block == no_row || points.zone[row] == no_row) return {block};
    return {block, &model.zones.gridpoints[model.blocks.zones[block].first + points.zone[row]], &points.weights[row]};
}

NodeForce force_of_node(const Model& model, Row node) {
    const auto& structures = model.structures;
    if (is_cable(model, node))
        return {structures.cable_nodes.force[node], Vec3::Zero(), structures.cable_nodes.position[node]};
    const auto& nodes = structures.member_nodes;
    const Row row = held_row(model, node).row;
    return {nodes.rock_force[row], nodes.rock_moment[row], nodes.rock[row]};
}

Vec3 direction_of_node(const Model& model, Row node) {
    return is_cable(model, node) ? direction_at(model, node) : normal_of_node(model, held_row(model, node).row);
}

Adjacency make_adjacency(const Model& model) {
    Adjacency adjacency;
    const auto& subs = model.sub_contacts;
    const auto& blocks = model.blocks;
    const auto sides = [&](Row s) {
        const Row contact = subs.contact[s];
        return std::array{std::pair{model.contacts.block1[contact], &subs.side1[s]},
                          std::pair{model.contacts.block2[contact], &subs.side2[s]}};
    };
    adjacency.of_gridpoint = sorted_lists<SideEntry>(model.gridpoints.size(), [&](auto add) {
        for (Row s = 0; s < static_cast<Row>(subs.size()); ++s)
            for (std::int32_t side = 0; side < 2; ++side) {
                const auto [block, attachment] = sides(s)[side];
                if (!blocks.deformable[block]) continue;
                for (int k = 0; k < 3; ++k)
                    if (attachment->weights[k] != 0)
                        add(attachment->gridpoints[k], SideEntry{s, side, attachment->weights[k]});
            }
    });
    adjacency.of_block = sorted_lists<ContactEntry>(blocks.size(), [&](auto add) {
        for (Row c = 0; c < static_cast<Row>(model.contacts.size()); ++c)
            for (std::int32_t side = 0; side < 2; ++side) {
                const Row block = side == 0 ? model.contacts.block1[c] : model.contacts.block2[c];
                if (!blocks.deformable[block]) add(block, ContactEntry{c, side});
            }
    });
    adjacency.bodies = joined_bodies(model);
    if (model.structures.stand()) list_nodes(model, adjacency);
    return adjacency;
}

} // namespace kaya
