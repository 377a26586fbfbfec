// Overlap contacts of separated blocks.
#pragma once

#include "mechanics/shape/overlap_patch.hpp"

namespace kaya {

/// Two separated blocks: where they will meet, and their distance along the normal. The place is a corner of the smaller block; for equal
/// blocks the one nearer to the other block's centre: a corner of a large floor may be far from the falling block and would give its
/// contact a very long arm.
struct Between {
    Vec3 place = Vec3::Zero();
    double gap = 0;
};

Between nearest_corners(const Model& model, Row block1, Row block2, const Vec3& n);

/// Distance of two blocks along a direction, including the offset; a lower bound of their distance.
double gap_along(const Model& model, Row block1, Row block2, const Vec3& n, const ClosureOffset& offset);

/// Distance of the blocks of an overlap contact along its normal, including its offset; 0 where they overlap.
double gap_of_overlap(const Model& model, Row contact);

} // namespace kaya
