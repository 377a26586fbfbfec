// The smallest convex body around points.
#pragma once

#include "geometry/surface/surface.hpp"

namespace kaya {

/// Triangles of the hull, seen anticlockwise from outside; without faces when the points lie in one plane.
Surface convex_hull(const std::vector<Vec3>& points);

} // namespace kaya
