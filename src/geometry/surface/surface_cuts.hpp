// Cuts blocks by a surface of triangles: an ore body, a curved fault that may overhang.
#pragma once

#include "geometry/surface/joint_set.hpp"
#include "geometry/surface/surface.hpp"

#include <array>
#include <vector>

namespace kaya {

/// The surface of bodies, or one open surface.
struct CuttingSurface {
    std::vector<std::array<Vec3, 3>> triangles; ///< seen from outside anticlockwise, or from above
    std::vector<std::array<Vec3, 2>> rim;       ///< edges where an open surface ends; none for bodies
};

/// Bodies with their cavities, all closed; or one open surface without a cavity. Its upper side counts as outside; if it is upright, the side
/// towards x, or y. Throws Diagnostic: open and closed surfaces together, several open ones, faces that cannot be turned alike.
CuttingSurface cutting_surface(std::vector<Surface> bodies, std::vector<Surface> cavities);

/// Cuts each block into convex pieces inside or outside, or below and above, of the surface; blocks that it does not reach stay whole, and
/// only bodies swallow blocks. Pieces are not thinner than `thinnest`. Throws Diagnostic where an open surface ends inside of a block or winds
/// about itself there, and when there would be too many pieces for any machine.
SidedBlocks cut_by_surface(const std::vector<Polyhedron>& blocks, const CuttingSurface& surface, int id,
                           double thinnest, const ProgressCallback& progress = {});

} // namespace kaya
