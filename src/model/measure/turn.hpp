// Orientations as rotations.
#pragma once

#include "model/tables/blocks.hpp"

#include <Eigen/Geometry>

namespace kaya {

inline Eigen::Quaterniond quaternion(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

/// From the axes of a block to global ones.
inline Mat3 turn_of(const Blocks& blocks, Row block) {
    return quaternion(blocks.orientation[block]).toRotationMatrix();
}

} // namespace kaya
