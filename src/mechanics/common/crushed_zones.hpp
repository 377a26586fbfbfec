// Checks for zones that are crushed or inverted, whose stress has no meaning.
// reads: gridpoints.position, gridpoints.displacement, zones.gridpoints
// writes: nothing
#pragma once

#include "base/diagnostic.hpp"
#include "model/tables/model.hpp"

#include <string_view>

namespace kaya {

constexpr std::string_view zone_crushed = "zone-crushed"; ///< the code of both messages

/// Ends the run at the first zone that has less than a fifth of its volume left, or is flatter than two degrees, relative to its shape when
/// displacements were last reset. Throws a Diagnostic of a run with zone, block and place.
void check_crushed_zones(const Model& model);

/// The message for a zone without volume.
Diagnostic turned_over(const Model& model, Row zone);

} // namespace kaya
