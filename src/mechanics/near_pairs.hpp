// Pairs of blocks that may touch, found once for many searches.
#pragma once

#include "geometry/box_pairs.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Every box is given room around it. As long as all boxes stay in their room, all pairs that can touch are among
/// those whose rooms meet. So the list that it gives may be longer than it must be, and what is made of the pairs
/// must not depend on pairs that are too far apart.
class NearPairs {
public:
    /// Pairs (i, j), i > j, sorted; among them all whose boxes overlap.
    const std::vector<std::array<int, 2>>& of(const std::vector<Box>& boxes);

private:
    std::vector<Box> rooms_;
    std::vector<std::array<int, 2>> pairs_;
};

} // namespace kaya
