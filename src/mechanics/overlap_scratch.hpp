// Overlaps one after another use the same memory.
#pragma once

#include "geometry/flat_overlap.hpp"

#include <vector>

namespace kaya {

/// What overlap_patch keeps for its memory only: no result depends on it.
struct OverlapScratch {
    ConvexClip clip;
    DepthScratch depth;
    std::vector<HalfSpace> of_subject, of_other;           ///< faces of the block that is clipped, and of the other one
    std::vector<HalfSpace> face_of_subject, face_of_other; ///< those that lie on each other
    ConvexFace face1, face2;
    FlatOverlap flat;
};

} // namespace kaya
