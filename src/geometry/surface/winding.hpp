// Inside or outside of a closed surface of triangles. Private to geometry.
#pragma once

#include "geometry/surface/surface.hpp"

#include <array>
#include <vector>

namespace kaya {

using Triangles = std::vector<std::array<Vec3, 3>>;

/// The triangles of flat faces.
Triangles triangles_of(const Surface& surface);

/// Enclosed volume; below 0 when the triangles look inward.
double volume_of(const Triangles& triangles);

/// The part of all directions from a point in which it sees the triangle: above 0 when it sees its back, as from inside.
double part_of_turn(const std::array<Vec3, 3>& triangle, const Vec3& point);

/// How often the surface winds around a point: 1 inside, 0 outside, any other number where it crosses itself or looks inward.
int winding(const Triangles& triangles, const Vec3& point);

} // namespace kaya
