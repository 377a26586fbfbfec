// Forces of the cables: docs/theory/cables.md.
// reads: blocks.centroid, blocks.orientation, blocks.velocity, gridpoints.position, gridpoints.velocity, zones.stress, structures.properties, settings, clock.time_step
// writes: structures.cable_nodes
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/structures/cable_chain.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Reads positions of blocks and gridpoints and zone stresses; writes positions, slips and forces of the nodes and bars of cables. Every
/// cable is in equilibrium with the present rock, `step` after the last call. `chains` is scratch memory. Returns the work of the rock on
/// the cables since then.
double run_cables(Model& model, std::vector<CableChain>& chains, double step);

/// Upper bounds of the stiffness with which a cable holds the rock at a node, along it and across. Equations (7) and (8) of
/// docs/theory/cables.md.
NodeStiffness cable_node_stiffness(const Model& model, Row node);

/// Unit vector along the cable at a node, from the places of its neighbours.
Vec3 direction_at(const Model& model, Row node);

} // namespace kaya
