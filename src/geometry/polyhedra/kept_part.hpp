// The part of a convex polygon on one side of a plane.
#pragma once

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

} // namespace kaya
