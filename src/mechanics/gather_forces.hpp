// Forces on bodies, gathered in the order of rows.
// reads: contacts.position, gridpoints.load, blocks.load, blocks.torque, ties.force, structures, settings.gravity
// writes: blocks.force, blocks.moment, gridpoints.force, clock.unbalanced_force, clock.average_ratio, clock.maximum_ratio, clock.local_ratio
#pragma once

#include "mechanics/adjacency.hpp"
#include "mechanics/advance_joints.hpp"
#include "mechanics/member_lists.hpp"
#include "mechanics/zone_tiles.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

class TieLists;

/// Sums the forces of contacts, zones, ties and structures. Returns the power of the forces of joints and zones on the bodies.
double gather_forces(Model& model, const Adjacency& adjacency, const TieLists& ties, const JointForces& joints,
                     const ZoneTiles& tiles, const std::vector<PointRow>& zone_forces, const MemberLists& members);

} // namespace kaya
