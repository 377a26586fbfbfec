// Zones that are squeezed to nothing or turned over: what they answer is no rock any more.
// reads: gridpoints.position, gridpoints.displacement, zones.gridpoints
// writes: nothing
#pragma once

#include "base/diagnostic.hpp"
#include "model/model.hpp"

namespace kaya {

/// Ends the run at the first zone that has less than a fifth of its volume left, or is flatter than two degrees, compared with
/// the shape that it had when displacements were last reset. Throws a Diagnostic of a run with zone, block and place.
void check_crushed_zones(const Model& model);

/// What to say of a zone that has no volume left.
Diagnostic turned_over(const Model& model, Row zone);

} // namespace kaya
