// Undamped modes of rigid bodies on the springs of their joints: docs/theory/motion.md, equation (7).
#pragma once

#include "base/progress_callback.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

struct EigenMode {
    double frequency = 0;            ///< cycles/time; 0 for a motion that no joint resists
    Vec3 moving_mass = Vec3::Zero(); ///< part of the mass of all free bodies that moves along x, y and z
};

/// The modes with the lowest frequencies, at most `count`, ascending. Springs are the present stiffnesses of sub-contacts and masses the
/// true ones; held components do not move. The model must be prepared. Throws Diagnostic when a block has zones, when structures are in the
/// model, or when no body can move.
std::vector<EigenMode> eigen_modes(const Model& model, int count, const ProgressCallback& progress = {});

} // namespace kaya
