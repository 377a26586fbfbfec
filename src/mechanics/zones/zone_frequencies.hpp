// Effect of zones on the time step: docs/theory/time-step.md.
// reads: gridpoints.position, gridpoints.mass, zones.gridpoints
// writes: gridpoints.zone_frequency
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "model/tables/model.hpp"

#include <array>

namespace kaya {

class ZoneLaws;

/// Greatest eigenvalue, or more, of the stiffness of an elastic cell with these corners: equation (7a) of docs/theory/time-step.md.
double stiffness_of_cell(const std::array<Vec3, 8>& place, const ElasticConstants& elastic);

void zone_frequencies(Model& model, const ZoneLaws& laws);

} // namespace kaya
