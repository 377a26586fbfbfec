// The convex outline of points seen from above.
#pragma once

#include "base/vector.hpp"

#include <vector>

namespace kaya {

/// Of the plan: positive where o, a, b turn to the left.
inline double plan_cross(const Vec3& o, const Vec3& a, const Vec3& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (b.x() - o.x()) * (a.y() - o.y());
}

/// Those of the points that are corners of their outline in the plan, anticlockwise (Andrew's chain).
std::vector<Vec3> plan_hull(std::vector<Vec3> points);

} // namespace kaya
