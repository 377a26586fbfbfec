// How well a tetrahedron is shaped. Private to geometry.
#pragma once

#include "base/vector.hpp"

#include <array>

namespace kaya {

/// The three corners opposite each corner, anticlockwise seen from it.
constexpr std::array<std::array<int, 3>, 4> seen_from_corner{{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// 6 sqrt(2) volume over the cube of the root mean square edge: 1 for a regular tetrahedron, near 0 for a
/// flat one of any kind, below 0 for an inverted one. (Parthasarathy, Graichen and Hathaway 1994.)
double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The least sine of an angle between two faces, or the shape's quality when that is less: 0.943 for a regular tetrahedron, below 0 for an
/// inverted one.
double least_sine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, bool with_shape);

} // namespace kaya
