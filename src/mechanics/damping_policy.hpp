// How adaptive global damping follows the motion: docs/theory/damping.md.
// reads: settings.damping, settings.global_ratio, clock.time_step
// writes: clock.global_viscosity
#pragma once

#include "mechanics/phase_sums.hpp"
#include "model/model.hpp"

namespace kaya {

/// What begins to move does so overdamped, so that no joint slips in an overshoot before the viscosity has come down.
void start_viscosity(Model& model);

/// More viscosity where damping takes less than its part of the change of kinetic energy, less where it takes more.
void adapt_viscosity(Model& model, const MotionSums& motion);

} // namespace kaya
