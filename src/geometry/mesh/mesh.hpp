// Tetrahedra that fill a polyhedron.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

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
    int per_cell = 0; ///< tetrahedra of a cell, which are consecutive; 0: no cells
};

/// A six-faced block with eight vertices and four-cornered faces, divided into cells of six tetrahedra each (Kuhn), with the given numbers
/// along each of the block's own axes, its edges nearest to x, y and z; every cell is `ratio` times as long as the one before it in the
/// direction of growing x, y or z. None when the polyhedron is of another kind or a tetrahedron would have no volume.
std::optional<TetMesh> hexahedron_mesh(const Polyhedron& polyhedron, const std::array<int, 3>& parts,
                                       const std::array<double, 3>& ratio = {1, 1, 1});

/// A conforming mesh of any convex polyhedron with edges close to `edge`, or to the polyhedron's own where those are shorter. Bricks and
/// similar shapes are divided into cells where that gives good shapes; other shapes get triangles on their faces, and Delaunay tetrahedra
/// of evenly spread points behind them, improved by moving points and exchanging tetrahedra until no flat one is left. The polyhedron's
/// vertices are points of the mesh, bit for bit. MeshPlan does the same for many blocks. Throws Diagnostic when the edge is not above 0 or
/// the mesh would exceed the memory. `progress` is called from time to time, with 0.
TetMesh make_mesh(const Polyhedron& polyhedron, double edge, const ProgressCallback& progress = {});

/// Shapes with no angle below this are good enough to stop trying; degrees.
constexpr double good_angle = 18;

/// Smallest and largest angle between two faces of a tetrahedron, degrees. 70.5 and 70.5 in a regular one.
struct DihedralAngles {
    double smallest = 180, largest = 0;
};
DihedralAngles dihedral_angles(const TetMesh& mesh);

} // namespace kaya
