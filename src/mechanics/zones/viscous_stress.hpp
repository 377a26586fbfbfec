// Viscous stresses of zones whose model may change their stress otherwise than by the strain of the step: docs/theory/damping.md, (7a).
#pragma once

#include "mechanics/common/elastic_constants.hpp"
#include "mechanics/zones/cells.hpp"

namespace kaya {

/// `damping` times the part of a change of stress that the strain of the step has made. Stress that falls to a new strength or pore pressure
/// does so at once, at no rate.
inline SixEights viscous_stress(const SixEights& change, const SixEights& strain, const ElasticConstants& elastic,
                                double damping) {
    const Eight mean = mean_of_three(change);
    SixEights deviator = change;
    for (std::size_t k = 0; k < 3; ++k) deviator[k] -= mean;
    const Eight work = product(change, strain),
                stored = product(deviator, deviator) / elastic.two_shear + mean * mean / elastic.bulk();
    const Eight most = work < stored ? work / stored : eights(1), part = work > 0 ? most : Eight{};
    SixEights viscous;
    for (std::size_t k = 0; k < 6; ++k) viscous[k] = damping * part * change[k];
    return viscous;
}

} // namespace kaya
