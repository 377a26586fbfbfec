// Water pressure on a joint, exact where its line of no pressure crosses the joint.
#pragma once

#include "geometry/polyhedra/kept_part.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/water.hpp"

#include <array>

namespace kaya {

/// Calls visit(area, place) with areas at places of a convex polygon that integrate polynomials of the second degree exactly: a third of each
/// triangle of its fan at the middles of the sides.
template <class Visit> void each_third(const std::vector<Vec3>& polygon, const Visit& visit) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const std::array<Vec3, 3> corners{polygon[0], polygon[i], polygon[i + 1]};
        const double area = triangle_area_vector(corners[0], corners[1], corners[2]).norm();
        for (std::size_t k = 0; k < corners.size(); ++k)
            visit(area / 3, Vec3(0.5 * (corners[k] + corners[(k + 1) % corners.size()])));
    }
}

/// Calls push(force, place) with forces across a part of a joint whose sum, also of their moments, is that of the pressure. Not where gridpoints
/// have the pressure.
template <class Push> void push_water(const std::vector<Vec3>& polygon, const WaterPressure& water, const Push& push) {
    const auto wet = kept_part(polygon, [&](const Vec3& corner) { return -water.unlimited_at(corner); });
    each_third(wet, [&](double area, const Vec3& place) { push(area * water.unlimited_at(place), place); });
}

/// The same for a whole joint.
template <class Push> void push_water(const Model& model, Row contact, const WaterPressure& water, const Push& push) {
    for (const auto& polygon : joint_polygons(model, contact)) push_water(polygon, water, push);
}

} // namespace kaya
