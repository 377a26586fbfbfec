// Motion and forces of beams and liners: docs/theory/beams-and-liners.md.
// reads: blocks.centroid, blocks.orientation, blocks.velocity, gridpoints.position, gridpoints.velocity, structures.properties, settings, clock.time_step
// writes: structures.member_nodes, structures.beams, structures.liners
#pragma once

#include "mechanics/structures/member_lists.hpp"
#include "mechanics/common/phase_sums.hpp"

namespace kaya {

/// Advances velocities and positions of free nodes by one step.
MotionSums move_members(Model& model, const MemberLists& lists);

/// Forces of elements and links for the present positions of nodes and rock, `step` after the last call; nodes held without springs move
/// with the rock. Returns the work of nodes and rock on the members.
double run_members(Model& model, MemberLists& lists, double step);

} // namespace kaya
