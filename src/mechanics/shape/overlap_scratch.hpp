// Scratch memory for consecutive overlaps.
#pragma once

#include "geometry/overlay/flat_overlap.hpp"
#include "geometry/polyhedra/depth_integral.hpp"

#include <vector>

namespace kaya {

/// Scratch memory of overlap_patch: no result depends on it.
struct OverlapScratch {
    ConvexClip clip;
    DepthScratch depth;
    std::vector<HalfSpace> of_subject, of_other;           ///< faces of the block that is clipped, and of the other one
    std::vector<HalfSpace> face_of_subject, face_of_other; ///< the parallel ones
    ConvexFace face1, face2;
    FlatOverlap flat;
};

} // namespace kaya
