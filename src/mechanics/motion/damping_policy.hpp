// Adaptive global damping: docs/theory/damping.md.
// reads: settings.damping, settings.global_ratio, clock.time_step
// writes: clock.global_viscosity
#pragma once

#include "mechanics/common/phase_sums.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Motion starts overdamped, so that no joint slips in an overshoot before the viscosity has decreased.
void start_viscosity(Model& model);

/// Raises the viscosity where damping takes less than its part of the change of kinetic energy, and lowers it where it takes more.
void adapt_viscosity(Model& model, const MotionSums& motion);

} // namespace kaya
