// A surface of triangles that share their corners, made from the faces of many blocks.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <vector>

namespace kaya {

struct SurfaceMesh {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< anticlockwise seen from the side that they face
};

/// Merges corners closer than the tolerance into the first one. Narrower triangles are removed.
SurfaceMesh joined_surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance);

/// Divides triangles where corners of others lie on their sides, so that neighbours share whole sides.
void cut_at_corners(SurfaceMesh& mesh, double tolerance);

/// Halves triangles at their longest sides until no side is longer than `edge`, and turns sides between triangles of one plane where that
/// makes better ones. No angle becomes much smaller than the smallest that there was (Rivara 1984).
void refine(SurfaceMesh& mesh, double edge);

/// Keeps the marked triangles and their points.
void keep_triangles(SurfaceMesh& mesh, const std::vector<char>& kept);

} // namespace kaya
