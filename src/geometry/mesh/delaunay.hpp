// Delaunay tetrahedra of a set of points. Private to geometry.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Tetrahedra of positive orientation that fill the convex hull. Does not depend on the order of the points
/// where more than four lie on one sphere; the list is sorted.
std::vector<std::array<int, 4>> delaunay(const std::vector<Vec3>& points);

} // namespace kaya
