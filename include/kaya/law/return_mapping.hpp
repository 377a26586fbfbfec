// SPDX-License-Identifier: MIT
// The way back to a strength from a trial that is beyond it: what a law with springs and slip does in each step.
//
// Stresses here, not forces. Slip s opens the joint by d s, where d is the tangent of the angle of dilation, and the normal
// spring answers that with compression:
//     shear = trial_shear - ks s,   normal = trial_normal + kn d s,   shear = strength(normal, s)          (1)
#pragma once

#include "kaya/law/root.hpp"

#include <algorithm>

namespace kaya::joints {

/// The stresses after the return; shear is the length of the vector, whose direction does not change.
///
/// The energy dissipated by a step per area is the work of its mean stresses on the slip and on the opening by dilation:
///     (shear_before + shear)/2 slip - (normal_before + normal)/2 opening                                   (2)
/// It is the work done on the joint less the increase of the energy of its springs. Stresses before are those at the start of the
/// step, not of the trial; a shear vector counts with its component along the trial.
struct Returned {
    double normal, shear;
    double slip;    ///< in this step, from 0
    double opening; ///< by dilation
    /// The first term of (2), energy per area: the whole of it without dilation.
    double work(double shear_before) const { return 0.5 * (shear_before + shear) * slip; }
    /// The second term of (2): the work of dilation on the load that it lifts, to be subtracted.
    double lifting(double normal_before) const { return 0.5 * (normal_before + normal) * opening; }
};

struct Springs {
    double normal, shear; ///< stress/length
};

/// Coulomb: strength = cohesion + normal tan_friction, not below 0. Plain arithmetic without a branch that stops a loop from
/// becoming vector instructions.
[[gnu::always_inline]] inline Returned return_to_coulomb(double trial_normal, double trial_shear, Springs k,
                                                         double cohesion, double tan_friction, double tan_dilation) {
    const double excess = trial_shear - std::max(0.0, cohesion + trial_normal * tan_friction);
    const double slip = std::max(0.0, excess) / (k.shear + k.normal * tan_friction * tan_dilation);
    // Beyond that the shear would reverse: the strength is 0 there.
    const double kept = std::min(slip, trial_shear / k.shear);
    const double opening = tan_dilation * kept;
    return {trial_normal + k.normal * opening, trial_shear - k.shear * kept, kept, opening};
}

/// Any continuous strength(normal, slip) that is not negative: solves (1) by the root of the difference, between no slip and the slip that
/// takes up the whole trial.
template <class Strength>
Returned return_to(Strength strength, double trial_normal, double trial_shear, Springs k, double tan_dilation) {
    const auto normal_at = [&](double slip) { return trial_normal + k.normal * tan_dilation * slip; };
    const auto excess = [&](double slip) { return trial_shear - k.shear * slip - strength(normal_at(slip), slip); };
    if (!(excess(0) > 0)) return {trial_normal, trial_shear, 0, 0};
    const double slip = bracketed_root(excess, 0, trial_shear / k.shear).x;
    return {normal_at(slip), std::max(0.0, trial_shear - k.shear * slip), slip, tan_dilation * slip};
}

} // namespace kaya::joints
