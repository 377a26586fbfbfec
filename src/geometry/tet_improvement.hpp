// Better shapes for a mesh of tetrahedra. Private to geometry.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/mesh_points.hpp"
#include "geometry/polyhedron.hpp"

#include <array>
#include <vector>

namespace kaya {

/// 6 sqrt(2) volume over the cube of the root mean square edge: 1 for a regular tetrahedron, near 0 for a
/// flat one of any kind, below 0 for an inverted one. (Parthasarathy, Graichen and Hathaway 1994.)
double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Moves points (within the faces and edges they lie on; vertices of the polyhedron stay) and exchanges
/// tetrahedra around badly shaped ones while the worst of each neighbourhood gets better, as long as there is an end to it.
void improve(const Polyhedron& polyhedron, MeshPoints& points, std::vector<std::array<int, 4>>& tetrahedra,
             const ProgressCallback& progress = {});

} // namespace kaya
