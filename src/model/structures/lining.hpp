// The surface that a liner gets: faces of blocks that nothing covers.
#pragma once

#include "geometry/surface/surface_mesh.hpp"
#include "model/tables/blocks.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

struct Model;

struct Lining {
    SurfaceMesh mesh;
    double area = 0;
    std::size_t covered = 0; ///< triangles covered by other blocks, left out
    std::size_t partly = 0;  ///< triangles covered in part; their middles decide
};

/// `edge`: the longest side; 0: the triangles of the faces. `tolerance`: corners closer than this are merged, and blocks closer than this
/// cover a face. 0: a ten thousandth of the extent of the faces. It is set to the value used.
Lining line_faces(const Model& model, const std::vector<Row>& faces, double edge, double& tolerance);

/// About how many triangles there will be.
double expected_triangles(const Model& model, const std::vector<Row>& faces, double edge);

} // namespace kaya
