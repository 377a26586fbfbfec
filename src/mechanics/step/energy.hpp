// The account of energy: docs/theory/energy.md.
// reads: clock.time_step, clock.last_step, settings.energy, zones.stress
// writes: energy
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Books the sums of a step.
void keep_account(Model& model, const StepSums& step);

/// Elastic energy of all zones from their stress: p^2/(2 K) + s:s/(4 G) per volume. `elastic` has the constants of the blocks.
double energy_in_zones(const Model& model, const std::vector<ElasticConstants>& elastic);

} // namespace kaya
