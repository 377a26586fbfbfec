// A surface of triangles that share their corners, made from the faces of many blocks.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <vector>

namespace kaya {

struct SurfaceMesh {
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles; ///< anticlockwise seen from the side that they look to
};

/// Corners that are nearer to each other than the tolerance become one: that of the first. Triangles that are narrower than
/// it go.
SurfaceMesh joined_surface(const std::vector<std::array<Vec3, 3>>& triangles, double tolerance);

/// Cuts triangles where corners of others lie on their sides, so that neighbours share whole sides.
void cut_at_corners(SurfaceMesh& mesh, double tolerance);

/// Halves triangles at their longest sides until no side is longer than `edge`, and turns sides between triangles of one plane where that
/// makes better ones. No angle becomes much smaller than the smallest that there was (Rivara 1984).
void refine(SurfaceMesh& mesh, double edge);

/// Keeps the triangles whose mark is set, and the points that they have.
void keep_triangles(SurfaceMesh& mesh, const std::vector<char>& kept);

} // namespace kaya
