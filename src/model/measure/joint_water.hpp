// Water pressure on a joint, exact where its line of no pressure crosses the joint.
#pragma once

#include "geometry/polyhedra/kept_part.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/water.hpp"

#include <Eigen/Geometry>
#include <array>

namespace kaya {

/// Calls push(force, place) with forces across the joint whose sum, also of their moments, is that of the pressure. Not where gridpoints have the
/// pressure.
template <class Push> void push_water(const Model& model, Row contact, const WaterPressure& water, const Push& push) {
    for (const auto& polygon : joint_polygons(model, contact)) {
        const auto wet = kept_part(
            polygon, [&](const Vec3& corner) { return -water.unlimited_at(corner); },
            [](const Vec3& a, const Vec3& b, double part) -> Vec3 { return a + part * (b - a); });
        for (std::size_t i = 1; i + 1 < wet.size(); ++i) {
            const double area = 0.5 * (wet[i] - wet[0]).cross(wet[i + 1] - wet[0]).norm();
            // A linear pressure acts at the middles of the sides, on a third of the area each.
            const std::array<Vec3, 3> corners{wet[0], wet[i], wet[i + 1]};
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Vec3 middle = 0.5 * (corners[k] + corners[(k + 1) % corners.size()]);
                push(area / 3 * water.unlimited_at(middle), middle);
            }
        }
    }
}

} // namespace kaya
