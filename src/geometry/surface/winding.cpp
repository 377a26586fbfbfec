#include "geometry/surface/winding.hpp"

#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace kaya {

Triangles triangles_of(const Surface& surface) {
    Triangles triangles;
    for (const auto& face : surface.faces)
        for (const auto& t : triangles_of(surface.vertices, face))
            triangles.push_back({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
    return triangles;
}

double volume_of(const Triangles& triangles) {
    if (triangles.empty()) return 0;
    const Vec3 base = triangles.front()[0];
    double sum = 0;
    for (const auto& [a, b, c] : triangles) sum += (a - base).dot((b - base).cross(c - base));
    return sum / 6;
}

// The solid angle (Van Oosterom and Strackee 1983) over 4 pi.
double part_of_turn(const std::array<Vec3, 3>& triangle, const Vec3& point) {
    const Vec3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
    const double to_a = a.norm(), to_b = b.norm(), to_c = c.norm();
    return std::atan2(a.dot(b.cross(c)), to_a * to_b * to_c + a.dot(b) * to_c + b.dot(c) * to_a + c.dot(a) * to_b) /
           (2 * std::numbers::pi);
}

int winding(const Triangles& triangles, const Vec3& point) {
    double turns = 0;
    for (const auto& triangle : triangles) turns += part_of_turn(triangle, point);
    return static_cast<int>(std::lround(turns));
}

} // namespace kaya
