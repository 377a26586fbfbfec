#include "model/measure/water.hpp"

#include <algorithm>

namespace kaya {

WaterPressure::WaterPressure(const Model& model) : model_(model) {
    const Settings& settings = model.settings;
    if (settings.water == Water::field) {
        at_origin_ = settings.water_value;
        gradient_ = settings.water_direction;
    } else if (settings.water == Water::ground) {
        weight_ = -settings.water_value * settings.gravity.z();
    } else if (settings.water == Water::table) {
        // The depth is measured along gravity, from the plane of the table down.
        const double g = settings.gravity.norm();
        const Vec3& normal = settings.water_direction;
        const double slope = g > 0 ? -normal.dot(settings.gravity) / g : 0;
        if (slope <= 0) return;
        gradient_ = -settings.water_value * g / slope * normal;
        at_origin_ = -gradient_.dot(settings.water_origin);
    }
}

double WaterPressure::unlimited_at(const Vec3& place) const {
    if (weight_ != 0) return weight_ * (model_.water_ground.height_beyond(place.x(), place.y()) - place.z());
    return at_origin_ + gradient_.dot(place);
}

double WaterPressure::at(const Vec3& place) const { return std::max(0.0, unlimited_at(place)); }

bool WaterPressure::is_linear() const {
    const Water kind = model_.settings.water;
    return kind == Water::table || kind == Water::field;
}

double WaterPressure::at_gridpoint(Row gridpoint) const {
    const auto& points = model_.gridpoints;
    const Water water = model_.settings.water;
    if (water == Water::table || water == Water::field || water == Water::ground) return at(points.position[gridpoint]);
    return std::max(0.0, points.pore_pressure[gridpoint]);
}

double WaterPressure::of_zone(Row zone) const {
    double sum = 0;
    for (const Row g : model_.zones.gridpoints[zone]) sum += at_gridpoint(g);
    return 0.25 * sum;
}

} // namespace kaya
