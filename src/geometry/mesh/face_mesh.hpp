// Triangles that cover one face of a block. Private to geometry.
#pragma once

#include "base/vector.hpp"
#include "geometry/mesh/edge_field.hpp"

#include <array>
#include <vector>

namespace kaya {

/// A convex flat polygon and the points that divide its edges.
struct FaceOutline {
    std::vector<Vec3> corners;              ///< anticlockwise
    std::vector<std::vector<Vec3>> between; ///< of corner i and the one after it
};

struct FaceMesh {
    std::vector<Vec3> points;                  ///< the corners, the points between them in turn, those inside
    std::vector<std::array<int, 3>> triangles; ///< anticlockwise
};

/// Well-shaped triangles with edges close to the field's length, growing from shorter parts of the outline. They depend on the outline as
/// given only: for equal triangles on both sides of a face, start at the same corner and use the same direction. Throws Diagnostic where
/// the outline crosses itself.
FaceMesh mesh_face(const FaceOutline& outline, const EdgeField& field);

} // namespace kaya
