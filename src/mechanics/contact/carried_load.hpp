// What an overlap carries before its joint model runs.
#pragma once

#include "mechanics/shape/overlap_patch.hpp"

#include <array>

namespace kaya {

/// Normal force, stiffness, frictional work, shear forces and shear stiffnesses of the carriers, and of the first two of them the normal ones, of an overlap before a joint model sees them.
struct CarriedLoad {
    double force = 0, stiffness = 0, worn = 0;
    bool lies = false; ///< see OverlapStart, which gives it
    std::array<Vec3, carriers> shear,
        held; ///< held: what the joint model leaves of them in a step without shear motion
    std::array<double, carriers> worn_by_row{}, shear_stiffness{};
    std::array<double, 2> normal{}, normal_stiffness{};

    CarriedLoad() {
        shear.fill(Vec3::Zero());
        held = shear;
    }
    CarriedLoad(const Model& model, Row contact);
};

} // namespace kaya
