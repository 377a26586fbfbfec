// Faces of two convex blocks in contact, and their common area.
#pragma once

#include "geometry/polyhedra/plane.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <array>
#include <cstddef>

namespace kaya {

/// True when a face of one block lies against a face of the other, and none of the two is open: opposite normals (within a degree), a distance of at most `near`, and a
/// common area above a millionth of the smaller face.
bool faces_in_contact(const Polyhedron& a, const Polyhedron& b, double near);

/// Pairs of faces of both blocks that lie against each other in the same sense, open faces too.
std::vector<std::array<std::size_t, 2>> faces_against(const Polyhedron& a, const Polyhedron& b, double near);

/// The part of a plane `polygon` inside a convex outline that runs anticlockwise about `normal` (Sutherland and Hodgman 1974), projected
/// along the normal. Fewer than three corners mean none.
std::vector<Vec3> common_part(std::vector<Vec3> polygon, const std::vector<Vec3>& outline, const Vec3& normal);

/// The part of a convex polygon on the side of a plane that its normal, of any length, points away from.
std::vector<Vec3> part_below(const std::vector<Vec3>& polygon, const Plane& plane);

/// Area of a plane polygon times its unit normal.
Vec3 area_vector(const std::vector<Vec3>& polygon);

} // namespace kaya
