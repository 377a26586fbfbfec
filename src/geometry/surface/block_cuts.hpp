// Cuts many blocks without a joint set: by a tunnel outline, by polygons, or into equal parts.
#pragma once

#include "geometry/polyhedra/plane.hpp"
#include "geometry/surface/joint_set.hpp"

#include <array>
#include <vector>

namespace kaya {

/// The outline of a tunnel: polygons with matching corners, and the straight sides from each to the next.
struct TunnelOutline {
    std::vector<std::vector<Vec3>> sections; ///< at least two
    bool radial =
        false;  ///< also cuts the rock around along the planes through the axis of the first two and each corner
    int id = 0; ///< stored on the cut faces
};

/// The section, which lies at the first point of a path, moved along the path: it is mitred where the path turns, and ends at right angles
/// to the last stretch. Throws Diagnostic: less than two points, points on each other, a turn that is too sharp for the section.
std::vector<std::vector<Vec3>> sections_along(const std::vector<Vec3>& section, const std::vector<Vec3>& path);

/// Cuts the outline out of the blocks. Blocks are cut no more than necessary: a side of the tunnel cuts a piece of rock only where it
/// separates the piece from the inside. Throws Diagnostic when the outline is not a solid (see make_prism).
SidedBlocks cut_tunnel(const std::vector<Polyhedron>& blocks, const TunnelOutline& outline, double thinnest = 0,
                       const ProgressCallback& progress = {});

/// Cuts each block into n[0] x n[1] x n[2] parts of equal width along x, y and z of its own box; no piece is thinner than `thinnest`.
/// Throws Diagnostic when a number is below 1.
CutBlocks densify(const std::vector<Polyhedron>& blocks, const std::array<int, 3>& parts, int id = 0,
                  double thinnest = 0, const ProgressCallback& progress = {});

/// A polygon and its plane.
struct CuttingPolygon {
    std::vector<Vec3> corners;
    Plane plane;
};

/// The polygon of that number, from 0, with the plane of its corners. Throws Diagnostic when it has no area or does not lie in a plane.
CuttingPolygon cutting_polygon(const std::vector<Vec3>& polygon, std::size_t number);

/// Cuts each block by the plane of each polygon that passes through it, over the whole width of the block, in the order of the polygons; what
/// a polygon only touches stays whole.
CutBlocks cut_by_polygons(const std::vector<Polyhedron>& blocks, const std::vector<CuttingPolygon>& polygons, int id,
                          double thinnest = 0, const ProgressCallback& progress = {});

} // namespace kaya
