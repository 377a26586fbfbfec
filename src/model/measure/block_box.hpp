// The box around a block.
#pragma once

#include "geometry/polyhedra/box_pairs.hpp"
#include "model/tables/model.hpp"

#include <limits>

namespace kaya {

/// The smallest box around the gridpoints of a block.
inline Box block_box(const Model& model, Row block) {
    Box box{Vec3::Constant(std::numeric_limits<double>::infinity()),
            Vec3::Constant(-std::numeric_limits<double>::infinity())};
    const Span span = model.blocks.gridpoints[block];
    for (Row g = span.first; g < span.end(); ++g) {
        box.low = box.low.cwiseMin(model.gridpoints.position[g]);
        box.high = box.high.cwiseMax(model.gridpoints.position[g]);
    }
    return box;
}

} // namespace kaya
