// Plane figures in their own axes.
#pragma once

#include "base/vector.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace kaya {

/// A plane figure in its own axes: two along the plane, one across.
struct FigurePlane {
    Vec3 origin, along, across, normal;

    Eigen::Vector2d flat(const Vec3& p) const { return {along.dot(p - origin), across.dot(p - origin)}; }
    double height(const Vec3& p) const { return std::abs(normal.dot(p - origin)); }
};

inline FigurePlane plane_of(const Vec3& origin, const Vec3& along, const Vec3& normal) {
    const Vec3 first = along.normalized();
    return {origin, first, normal.normalized().cross(first), normal.normalized()};
}

inline double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d edge = b - a;
    const double length2 = edge.squaredNorm();
    const double share = length2 > 0 ? std::clamp(edge.dot(p - a) / length2, 0.0, 1.0) : 0;
    return (p - a - share * edge).norm();
}

/// Inside, or within the tolerance of the outline. Counts the edges crossed by a ray along the first axis.
inline bool inside_outline(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p, double tolerance) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if (distance_to_segment(p, a, b) <= tolerance) return true;
        if ((a[1] > p[1]) == (b[1] > p[1])) continue;
        if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
    }
    return inside;
}

} // namespace kaya
