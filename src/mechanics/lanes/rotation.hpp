// Inertia of a rigid block in its present orientation.
#pragma once

#include "model/tables/model.hpp"
#include "model/measure/turn.hpp"

namespace kaya {

/// Tensor of inertia about the centroid in global axes with the inertial mass, mass times length^2. Requires a known mass.
inline Mat3 inertia_now(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    const Mat3 turn = turn_of(blocks, block);
    return turn * (blocks.inertia[block] * (blocks.inertial_mass[block] / blocks.volume[block])) * turn.transpose();
}

/// Sum of arm x force, from the sum of arm times force in global axes.
inline Vec3 moment_of(const Mat3& arms_times_forces) {
    const Mat3& t = arms_times_forces;
    return {t(1, 2) - t(2, 1), t(2, 0) - t(0, 2), t(0, 1) - t(1, 0)};
}

/// Blocks::load_arms in global axes, for the present orientation.
inline Mat3 arms_now(const Model& model, Row block) {
    return turn_of(model.blocks, block) * model.blocks.load_arms[block];
}

/// Moment of all loads on a rigid block about its centroid, for the present orientation.
inline Vec3 load_moment(const Model& model, Row block) {
    return model.blocks.torque[block] + moment_of(arms_now(model, block));
}

} // namespace kaya
