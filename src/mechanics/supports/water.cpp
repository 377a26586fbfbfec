// Water pressure in joints: docs/theory/loads.md.
#include "base/reduce.hpp"
#include "mechanics/supports/water.hpp"
#include "model/measure/water.hpp"

#include <algorithm>

namespace kaya {

namespace {

/// Pressure at one side of a joint, from the adjacent gridpoints.
double pressure_next_to(const WaterPressure& water, const Attachment& side) {
    double sum = 0;
    if (side.attached())
        for (int k = 0; k < 3; ++k) sum += side.weights[k] * water.at_gridpoint(side.gridpoints[k]);
    return sum;
}

} // namespace

void put_water(Model& model) {
    if (model.settings.water == Water::none) return;
    const WaterPressure water(model);
    if (model.settings.water == Water::points) {
        auto& subs = model.sub_contacts;
        for_chunks(subs.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                subs.pore_pressure[i] = std::max(
                    0.0, 0.5 * (pressure_next_to(water, subs.side1[i]) + pressure_next_to(water, subs.side2[i])));
        });
        return;
    }
    auto& s = model.sub_contacts;
    for_chunks(s.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) s.pore_pressure[i] = water.at(s.position[i]);
    });
}

} // namespace kaya
