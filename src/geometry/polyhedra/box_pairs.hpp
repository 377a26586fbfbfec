// Boxes around points, and which of many boxes overlap.
#pragma once

#include "base/vector.hpp"

#include <array>
#include <vector>

namespace kaya {

struct Box {
    Vec3 low, high;
};

/// The smallest box around one point or more.
Box box_around(const std::vector<Vec3>& points);

/// All pairs (i, j), i > j, of boxes that overlap or touch; sorted. Cost grows like n log n plus the
/// number of pairs.
std::vector<std::array<int, 2>> overlapping_boxes(const std::vector<Box>& boxes);

} // namespace kaya
