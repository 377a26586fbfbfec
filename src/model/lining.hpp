// The surface that a liner gets: faces of blocks that nothing covers.
#pragma once

#include "geometry/surface_mesh.hpp"
#include "model/blocks.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

struct Model;

struct Lining {
    SurfaceMesh mesh;
    double area = 0;
    std::size_t covered = 0; ///< triangles that lie on other blocks, and are left out
    std::size_t partly = 0;  ///< triangles that lie on other blocks in parts; their middles decide
};

/// `edge`: no side is longer; 0: triangles are those of the faces. `tolerance`: corners that are nearer to each other are one, and
/// blocks that are nearer than it cover a face. 0: a ten thousandth of the extent of the faces. It becomes what was taken.
Lining line_faces(const Model& model, const std::vector<Row>& faces, double edge, double& tolerance);

/// About how many triangles there will be.
double expected_triangles(const Model& model, const std::vector<Row>& faces, double edge);

} // namespace kaya
