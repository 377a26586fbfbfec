// Blocks with six faces of four corners, as grids. Private to geometry.
#pragma once

#include "geometry/mesh/mesh.hpp"

#include <array>
#include <optional>
#include <vector>

namespace kaya {

/// The eight vertices as corners of a cube: corner i + 2 j + 4 k is at the ends i, j, k of the three axes, which are right-handed. Corner 0
/// is the lowest vertex. None for other polyhedra.
std::optional<std::array<int, 8>> hexahedron_corners(const Polyhedron& polyhedron);

/// Positions of points along each axis of a grid, on a unit length, with its ends.
using GridPlaces = std::array<std::vector<double>, 3>;

/// Cells between the places along each axis, six tetrahedra in each, all with an edge from the end nearest to corner 0 to the one nearest to corner 7.
TetMesh grid_mesh(const Polyhedron& polyhedron, const std::array<int, 8>& corner, const GridPlaces& places);

} // namespace kaya
