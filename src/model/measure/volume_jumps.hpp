// Zones adjacent to much larger zones.
#pragma once

#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

struct VolumeJumps {
    std::size_t count = 0; ///< of pairs of zones with a common face
    double worst = 1;      ///< the larger volume over the smaller one
    Vec3 place = Vec3::Zero();
    std::array<Row, 2> blocks{no_row, no_row}; ///< of the worst, the one with the larger zone first
};

/// Pairs whose volumes differ by more than 4 to 1, inside blocks and across faces that share their triangles.
VolumeJumps volume_jumps(const Model& model, const std::vector<Row>& blocks);

} // namespace kaya
