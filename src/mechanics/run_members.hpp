// Motion and forces of beams and liners: docs/theory/beams-and-liners.md.
// reads: blocks.centroid, blocks.orientation, blocks.velocity, gridpoints.position, gridpoints.velocity, structures.properties, settings, clock.time_step
// writes: structures.member_nodes, structures.beams, structures.liners
#pragma once

#include "mechanics/member_lists.hpp"
#include "mechanics/phase_sums.hpp"

namespace kaya {

/// Velocities and places of the nodes that move by themselves, one step on.
MotionSums move_members(Model& model, const MemberLists& lists);

/// Forces of elements and links as nodes and rock lie now, `step` after the last call; nodes that hang on the rock without springs go along
/// with it. Returns the work that nodes and rock have done on the members.
double run_members(Model& model, MemberLists& lists, double step);

} // namespace kaya
