// Which of two blocks a contact follows.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Whose surface defines the normal and the depth of a contact between rigid blocks: 1, that of block 1; 0, that of block 2, where one is
/// more than twice as large as the other; 0.5, the mean of both. It depends on the two blocks only, not on their order.
inline double part_of_first(const Model& model, Row block1, Row block2) {
    constexpr double larger = 2;
    const auto& volume = model.blocks.volume;
    if (volume[block1] > larger * volume[block2]) return 1;
    return volume[block2] > larger * volume[block1] ? 0 : 0.5;
}

} // namespace kaya
