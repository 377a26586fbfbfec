// Whether two convex blocks lie face on face.
#pragma once

#include "geometry/polyhedron.hpp"

namespace kaya {

/// True when a face of one lies against a face of the other: opposite normals (to a degree), no farther apart than
/// `near`, and a common area above a millionth of the smaller face.
bool faces_touch(const Polyhedron& a, const Polyhedron& b, double near);

} // namespace kaya
