// The part of a convex polygon on one side of a plane.
#pragma once

#include "base/vector.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// Corners in order; those of height 0 or less are kept. `height(corner)` is the distance above the plane, `between(a, b, part)` the point
/// at that part of the edge from a to b. Empty when less than a triangle is left.
template <class Corner, class Height, class Between>
std::vector<Corner> kept_part(const std::vector<Corner>& polygon, Height&& height, Between&& between) {
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const double height_a = height(a), height_b = height(b);
        if (height_a <= 0) kept.push_back(a);
        if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0))
            kept.push_back(between(a, b, height_a / (height_a - height_b)));
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

/// The same of a polygon of places.
template <class Height> std::vector<Vec3> kept_part(const std::vector<Vec3>& polygon, const Height& height) {
    return kept_part(polygon, height,
                     [](const Vec3& a, const Vec3& b, double part) -> Vec3 { return a + part * (b - a); });
}

} // namespace kaya
