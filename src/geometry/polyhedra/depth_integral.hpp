// The depth below the surface of a convex body, integrated over a part of it.
#pragma once

#include "geometry/polyhedra/convex_overlap.hpp"

#include <vector>

namespace kaya {

/// Scratch memory of depth_gradient: no result depends on it.
struct DepthScratch {
    std::vector<double> least;            ///< depth of the part below each face
    std::vector<std::size_t> near;        ///< lists of faces, one behind the other
    std::vector<ConvexClip> halves;       ///< a stack of regions
    std::vector<std::vector<Vec3>> loops; ///< a stack of polygons
};

/// The integral of the depth below the surface of one body, the distance to the nearest of its faces, over the intersection of two.
/// `of_subject`: of the body that was clipped; `second`: it is the second one. `faces` are those of the body whose depth counts: all of
/// them, or one alone.
OverlapGradient depth_gradient(const ConvexClip& part, const std::vector<HalfSpace>& faces, bool of_subject,
                               bool second, DepthScratch& scratch);

} // namespace kaya
