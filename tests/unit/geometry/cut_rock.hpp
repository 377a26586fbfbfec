// Blocks cut repeatedly.
#pragma once

#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/joint_set.hpp"

#include <algorithm>
#include <vector>

namespace kaya {

/// Cuts all blocks by a joint set and replaces cut blocks by their pieces.
inline void cut_rock(std::vector<Polyhedron>& blocks, const JointSet& set) {
    const CutBlocks cut = cut_blocks(blocks, set, 1e-3);
    std::vector<Polyhedron> next;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!std::ranges::binary_search(cut.parents, static_cast<int>(b))) next.push_back(blocks[b]);
    for (const auto& piece : cut.pieces) next.push_back(piece.polyhedron);
    blocks = std::move(next);
}

} // namespace kaya
