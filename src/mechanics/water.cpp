// Water pressure in joints: docs/theory/loads.md.
#include "base/reduce.hpp"
#include "mechanics/phases.hpp"

#include <algorithm>

namespace kaya {

LinearPressure water_pressure(const Settings& settings) {
    if (settings.water == Water::field) return {settings.water_value, settings.water_direction};
    const double g = settings.gravity.norm();
    const Vec3& normal = settings.water_direction;
    // The depth is measured along gravity, from the plane of the table down.
    const double slope = g > 0 ? -normal.dot(settings.gravity) / g : 0;
    if (slope <= 0) return {};
    const Vec3 gradient = -settings.water_value * g / slope * normal;
    return {-gradient.dot(settings.water_origin), gradient};
}

namespace {

/// Of one side of a joint, from the gridpoints around.
double pressure_beside(const Model& model, const Attachment& side) {
    double sum = 0;
    if (side.attached())
        for (int k = 0; k < 3; ++k) sum += side.weights[k] * model.gridpoints.pore_pressure[side.gridpoints[k]];
    return sum;
}

} // namespace

void put_water(Model& model) {
    if (model.settings.water == Water::none) return;
    if (model.settings.water == Water::points) {
        auto& subs = model.sub_contacts;
        for_chunks(subs.size(), 4096, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                subs.pore_pressure[i] =
                    std::max(0.0, 0.5 * (pressure_beside(model, subs.side1[i]) + pressure_beside(model, subs.side2[i])));
        });
        return;
    }
    const LinearPressure pressure = water_pressure(model.settings);
    auto& s = model.sub_contacts;
    for_chunks(s.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            s.pore_pressure[i] = std::max(0.0, pressure.at_origin + pressure.gradient.dot(s.position[i]));
    });
}

} // namespace kaya
