// Joints between rigid blocks with sub-contacts at their corners only, as 3DEC has them (`facetri corners`).
#pragma once

#include "model/tables/model.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

/// The shorter of two lengths; 0 stands for none.
inline double shorter_length(double a, double b) { return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b); }

/// The spacing of sub-contacts that two blocks ask for: the shorter of two lengths; 0: as the joint needs; infinity: at its corners only.
inline double length_between(const Model& model, Row block1, Row block2) {
    return shorter_length(model.blocks.face_edge[block1], model.blocks.face_edge[block2]);
}

/// Whether a joint between two rigid blocks has sub-contacts at its corners only. It opens corner by corner, where other joints become an
/// overlap.
inline bool stands_on_corners(const Model& model, Row block1, Row block2) {
    return std::isinf(length_between(model, block1, block2));
}

} // namespace kaya
