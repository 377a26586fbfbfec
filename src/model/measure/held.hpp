// What prescribed velocities hold.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// No point of the block can move.
bool is_held(const Model& model, Row block);

/// A force or a change of velocity without the components that the lowest three bits hold.
inline Vec3 free_part(Vec3 vector, unsigned fixed) {
    for (int k = 0; k < 3; ++k)
        if (fixed & (1u << k)) vector[k] = 0;
    return vector;
}

} // namespace kaya
