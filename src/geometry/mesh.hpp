// Tetrahedra that fill a polyhedron.
#pragma once

#include "geometry/polyhedron.hpp"

#include <array>
#include <optional>
#include <vector>

namespace kaya {

struct TetMesh {
    std::vector<Vec3> points;
    std::vector<std::array<int, 4>> tetrahedra; ///< positive volume in this order
    struct BoundaryTriangle {
        std::array<int, 3> points; ///< anticlockwise seen from outside
        int face;                  ///< index into Polyhedron::faces
    };
    std::vector<BoundaryTriangle> boundary;
};

/// A six-faced block with eight vertices and four-cornered faces, cut into n1 x n2 x n3 cells of six
/// tetrahedra each (Kuhn); n from the mean edge lengths, so that cells have edges close to `edge`.
/// Nothing when the polyhedron is not of that kind.
std::optional<TetMesh> hexahedron_mesh(const Polyhedron& polyhedron, double edge);

} // namespace kaya
