// Velocities set to zero.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Stops all bodies and structures. Prescribed components are left unchanged: a boundary condition is not an initial condition. The energy
/// account takes the change at the next cycle.
void stop_motion(Model& model);

} // namespace kaya
