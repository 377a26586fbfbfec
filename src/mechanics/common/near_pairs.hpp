// Pairs of blocks that may touch, found once for many searches.
#pragma once

#include "geometry/polyhedra/box_pairs.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Every box gets a margin. As long as all boxes stay within their margins, all pairs that can be in contact are in the list. The list may
/// be longer than necessary, so results must not depend on pairs that are too far apart.
class NearPairs {
public:
    /// Pairs (i, j), i > j, sorted; among them all whose boxes overlap.
    const std::vector<std::array<int, 2>>& of(const std::vector<Box>& boxes);

private:
    std::vector<Box> rooms_;
    std::vector<std::array<int, 2>> pairs_;
};

} // namespace kaya
