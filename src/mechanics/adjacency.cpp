#include "mechanics/adjacency.hpp"

namespace kaya {

namespace {

/// The corners of the zone that a cable node lies in; none in a rigid block.
const std::array<Row, 4>* corners_around(const Model& model, Row node, Row block) {
    const Row zone = model.structures.nodes.zone[node];
    return zone == no_row ? nullptr : &model.zones.gridpoints[model.blocks.zones[block].first + zone];
}

void list_cable_nodes(const Model& model, Adjacency& adjacency) {
    const auto& nodes = model.structures.nodes;
    const auto rows = static_cast<Row>(nodes.size());
    const auto each = [&](auto visit) {
        for (Row node = 0; node < rows; ++node) {
            const Row block = block_of_node(model, node);
            if (block != no_row) visit(node, block, corners_around(model, node, block));
        }
    };
    adjacency.nodes_of_block = sorted_lists<NodeEntry>(model.blocks.size(), [&](auto add) {
        each([&](Row node, Row block, const std::array<Row, 4>* corners) {
            if (corners == nullptr) add(block, NodeEntry{node, 1});
        });
    });
    adjacency.nodes_of_gridpoint = sorted_lists<NodeEntry>(model.gridpoints.size(), [&](auto add) {
        each([&](Row node, Row, const std::array<Row, 4>* corners) {
            for (std::size_t k = 0; corners != nullptr && k < 4; ++k)
                if (nodes.weights[node][k] != 0) add((*corners)[k], NodeEntry{node, nodes.weights[node][k]});
        });
    });
    for (Row node = 0; node < rows; ++node) adjacency.node_stiffness.push_back(node_stiffness(model, node));
}

} // namespace

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
    if (!model.structures.cables.empty()) list_cable_nodes(model, adjacency);
    return adjacency;
}

} // namespace kaya
