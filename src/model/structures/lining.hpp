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

/// The triangles of these faces, and those between three of these gridpoints: a face may run on beyond what is lined. Both lists in order.
std::vector<Row> triangles_to_line(const Model& model, const std::vector<Row>& faces,
                                   const std::vector<Row>& gridpoints);

/// `edge`: the longest side; 0: the triangles as they are. `tolerance`: corners closer than this are merged, and blocks closer than this
/// cover a triangle. 0: a ten thousandth of their extent. It is set to the value used.
Lining line_triangles(const Model& model, const std::vector<Row>& rows, double edge, double& tolerance);

/// About how many triangles there will be.
double expected_triangles(const Model& model, const std::vector<Row>& rows, double edge);

} // namespace kaya
