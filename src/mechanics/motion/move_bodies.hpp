// Advances rigid blocks and gridpoints by one step: docs/theory/motion.md.
// reads: blocks.force, blocks.moment, blocks.load, blocks.torque, blocks.inertial_mass, gridpoints.force, gridpoints.load, gridpoints.inertial_mass, settings, clock.time_step
// writes: blocks.velocity, blocks.rotational_velocity, blocks.angular_momentum, blocks.centroid, blocks.orientation, blocks.displacement, blocks.travelled, blocks.last_force, blocks.last_moment, gridpoints.velocity, gridpoints.position, gridpoints.displacement, gridpoints.last_force
#pragma once

#include "mechanics/common/phase_sums.hpp"
#include "mechanics/supports/quiet_boundary.hpp"
#include "model/edit/joined.hpp"
#include "model/tables/model.hpp"

namespace kaya {

class TieLists;

/// Rigid blocks, and the positions of their vertices. Joined blocks move as one.
MotionSums move_blocks(Model& model, const JoinedBodies& bodies);

/// Gridpoints of deformable blocks; viscous boundaries damp theirs, rollers constrain theirs, and those that are tied to each
/// other move as one.
MotionSums move_gridpoints(Model& model, const QuietPoints& quiet, const TieLists& ties);

} // namespace kaya
