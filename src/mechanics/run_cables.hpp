// Forces of the cables: docs/theory/cables.md.
// reads: blocks.centroid, blocks.orientation, gridpoints.position, zones.stress, structures.properties
// writes: structures.cable_nodes
#pragma once

#include "mechanics/adjacency.hpp"
#include "mechanics/cable_chain.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Reads the places of blocks and gridpoints and the stresses of zones; writes places, slips and forces of the nodes and bars
/// of cables. Every cable is in equilibrium with the rock as it stands. `chains` is kept for its memory. Gives the work that
/// the rock has done on the cables since the last call.
double run_cables(Model& model, std::vector<CableChain>& chains);

/// Stiffness with which a cable may hold the rock at a node, along it and in other directions: bounds, whatever slips or
/// yields. Equations (7) and (8) of docs/theory/cables.md.
NodeStiffness cable_node_stiffness(const Model& model, Row node);

/// Unit vector along the cable at a node, from the places of its neighbours.
Vec3 direction_at(const Model& model, Row node);

} // namespace kaya
