#include "mechanics/damping_policy.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Power of adaptive global damping over the rate of kinetic energy for a ratio of 1; calibrated on logs of 3DEC, docs/theory/damping.md.
constexpr double global_damping_scale = 4.6;
/// Rate of change of the viscosity at the largest stable step, from the same logs.
constexpr double viscosity_rate = 0.0033;

} // namespace

void start_viscosity(Model& model) {
    if (model.settings.damping == Damping::global && model.clock.global_viscosity == 0)
        model.clock.global_viscosity = 1 / model.clock.time_step;
}

void adapt_viscosity(Model& model, const MotionSums& motion) {
    if (model.settings.damping != Damping::global) return;
    double& viscosity = model.clock.global_viscosity;
    const double change = std::abs(motion.kinetic - motion.kinetic_before);
    const double rate = viscosity_rate * time_step_fraction(model.settings);
    viscosity *= motion.damped > global_damping_scale * model.settings.global_ratio * change ? 1 - rate : 1 + rate;
    viscosity = std::min(viscosity, 1 / model.clock.time_step);
}

} // namespace kaya
