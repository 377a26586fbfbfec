// The triangles that a surface is to have, laid over those that tetrahedra have. Private to geometry.
#pragma once

#include "geometry/mesh_points.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Tetrahedra of the surface's points, and others inside, have triangles in its faces that differ from the surface's: turns them edge by edge.
/// Each turn lays a tetrahedron without volume over the two triangles, which is of positive orientation in the order of its corners
/// and is to be taken out by exchanges. False when rounding has torn the tetrahedra's surface.
bool recover_surface(const Polyhedron& polyhedron, const BlockSurface& surface, const MeshPoints& points,
                     std::vector<std::array<int, 4>>& tetrahedra);

} // namespace kaya
