// Faces of two convex blocks in contact, and their common area.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

namespace kaya {

/// True when a face of one block lies against a face of the other: opposite normals (within a degree), a distance of at most `near`, and a
/// common area above a millionth of the smaller face.
bool faces_in_contact(const Polyhedron& a, const Polyhedron& b, double near);

/// The part of a plane `polygon` inside a convex outline that runs anticlockwise about `normal` (Sutherland and Hodgman 1974), projected
/// along the normal. Fewer than three corners mean none.
std::vector<Vec3> common_part(std::vector<Vec3> polygon, const std::vector<Vec3>& outline, const Vec3& normal);

/// Area of a plane polygon times its unit normal.
Vec3 area_vector(const std::vector<Vec3>& polygon);

} // namespace kaya
