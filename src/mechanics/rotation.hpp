// The inertia of a rigid block as it lies now.
#pragma once

#include "model/model.hpp"

#include <Eigen/Geometry>

namespace kaya {

inline Eigen::Quaterniond quaternion(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

/// Tensor of inertia about the centroid in global axes with the inertial mass, mass times length^2. The mass must
/// be known.
inline Mat3 inertia_now(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    const Mat3 turn = quaternion(blocks.orientation[block]).toRotationMatrix();
    return turn * (blocks.inertia[block] * (blocks.inertial_mass[block] / blocks.volume[block])) * turn.transpose();
}

} // namespace kaya
