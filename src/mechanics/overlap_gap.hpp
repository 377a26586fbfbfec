// Blocks whose contact goes by their overlap while they are apart.
#pragma once

#include "mechanics/overlap_patch.hpp"

namespace kaya {

/// Two blocks that are apart: where they will meet, and their distance along the normal. The place is a corner of the smaller
/// block, or of blocks that are alike the one nearer to the other block's centre: a corner of a large floor that lies as high as
/// all others may be far from what falls on it, and would give its contact an arm as long.
struct Between {
    Vec3 place = Vec3::Zero();
    double gap = 0;
};

Between nearest_corners(const Model& model, Row block1, Row block2, const Vec3& n);

/// How far apart two blocks are along a direction, offset included; a bound of their distance.
double gap_along(const Model& model, Row block1, Row block2, const Vec3& n, const ClosureOffset& offset);

/// How far apart the blocks of an overlap contact are along its normal, with its offset; 0 where they overlap.
double gap_of_overlap(const Model& model, Row contact);

} // namespace kaya
