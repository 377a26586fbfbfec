// Blocks whose gridpoints lie within one chunk of a loop over gridpoints: work that needs all of them is done there, while they are in the
// cache.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Whether all gridpoints of a block are in one chunk of `grain` rows.
inline bool in_one_chunk(Span gridpoints, std::size_t grain) {
    const auto chunk = [&](Row g) { return static_cast<std::size_t>(g) / grain; };
    return gridpoints.count > 0 && chunk(gridpoints.first) == chunk(gridpoints.end() - 1);
}

/// Calls each(block) for the deformable blocks all of whose gridpoints are in [first, last).
template <class Each>
void for_deformable_in(const Model& model, std::size_t first, std::size_t last, const Each& each) {
    for (std::size_t row = first; row < last;) {
        const Row block = model.gridpoints.block[row];
        const Span points = model.blocks.gridpoints[block];
        const auto begin = static_cast<std::size_t>(points.first), end = static_cast<std::size_t>(points.end());
        if (model.blocks.deformable[block] && begin >= first && end <= last) each(block);
        row = end;
    }
}

} // namespace kaya
