// Predicate for rows of gridpoints that move eight at a time.
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/lanes/eight.hpp"
#include "mechanics/ties/ties.hpp"

namespace kaya {

/// Whether rows [row, row + 8) are gridpoints of zones held by fixities and quiet boundaries only.
inline bool are_plain(const Model& model, const TieLists& ties, std::size_t row) {
    bool plain = all_in_zones(model, row) && all_zero_rows(&model.gridpoints.roller[row]);
    if (ties.groups() == 0) return plain;
    for (std::size_t l = row; plain && l < row + 8; ++l) plain = !ties.in_group(static_cast<Row>(l));
    return plain;
}

} // namespace kaya
