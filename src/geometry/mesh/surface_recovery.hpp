// Imposes the prescribed triangles of a surface on those of tetrahedra. Private to geometry.
#pragma once

#include "geometry/mesh/mesh_points.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Tetrahedra of the surface's points, and others inside, have triangles in its faces that differ from the surface's: swaps them edge by
/// edge. Each swap adds a tetrahedron without volume over the two triangles, positively oriented by the order of its corners, to be removed
/// by exchanges. False when rounding has torn the surface of the tetrahedra.
bool recover_surface(const Polyhedron& polyhedron, const BlockSurface& surface, const MeshPoints& points,
                     std::vector<std::array<int, 4>>& tetrahedra);

} // namespace kaya
