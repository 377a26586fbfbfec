// Which contacts and nodes act on each body: forces are gathered through these lists, in row order.
#pragma once

#include "mechanics/common/row_lists.hpp"
#include "model/edit/joined.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Whether gridpoints [row, row + 8) all belong to deformable blocks. The gridpoints of a block are consecutive.
inline bool all_in_zones(const Model& model, std::size_t row) {
    const auto& block = model.gridpoints.block;
    if (block[row] == block[row + 7]) return model.blocks.deformable[block[row]];
    bool all = true;
    for (std::size_t l = row; l < row + 8; ++l) all &= model.blocks.deformable[block[l]] != 0;
    return all;
}

/// One side of a sub-contact with the weight of a gridpoint in it.
struct SideEntry {
    Row sub_contact;
    std::int32_t side; ///< 0 or 1
    double weight;
};

/// A contact that a block has.
struct ContactEntry {
    Row contact;
    std::int32_t side; ///< 0 or 1
};

/// A structure node held in a rigid block, or in a zone with the weight of one of its corners.
struct NodeEntry {
    Row node;
    double weight;
};

/// Upper bound of the stiffness with which a structure node holds the rock: along a direction, across it, and in rotation.
struct NodeStiffness {
    double along = 0, across = 0, turning = 0;
};

struct Adjacency {
    Lists<SideEntry> of_gridpoint; ///< gridpoints of deformable blocks
    Lists<ContactEntry> of_block;  ///< rigid blocks
    JoinedBodies bodies;
    // Nodes of structures that act on the rock share one numbering: cables first, then beams and liners.
    Lists<NodeEntry> nodes_of_gridpoint;       ///< no rows where there are no structures
    Lists<NodeEntry> nodes_of_block;           ///< the same of rigid blocks; weight 1
    std::vector<NodeStiffness> node_stiffness; ///< by such a node

    bool has_structures() const { return !node_stiffness.empty(); }
};

Adjacency make_adjacency(const Model& model);

/// The force of a structure node on the rock, and its place.
struct NodeForce {
    Vec3 force, moment, place;
};
NodeForce force_of_node(const Model& model, Row node);

/// The direction of NodeStiffness::along.
Vec3 direction_of_node(const Model& model, Row node);

/// Where a node of a structure lies in the rock.
struct NodePlace {
    Row block = no_row;                          ///< none: outside
    const std::array<Row, 4>* corners = nullptr; ///< of its zone; none in a rigid block
    const std::array<double, 4>* weights = nullptr;
};
NodePlace place_of_held_node(const Model& model, Row node);

} // namespace kaya
