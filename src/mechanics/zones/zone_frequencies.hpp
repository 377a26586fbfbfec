// Effect of zones on the time step: docs/theory/time-step.md.
// reads: gridpoints.position, gridpoints.mass, zones.gridpoints
// writes: gridpoints.zone_frequency
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

class ZoneLaws;

/// `elastic` has the constants of the blocks.
void zone_frequencies(Model& model, const std::vector<ElasticConstants>& elastic, const ZoneLaws* laws = nullptr);

} // namespace kaya
