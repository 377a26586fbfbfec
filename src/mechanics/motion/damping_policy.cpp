#include "mechanics/motion/damping_policy.hpp"

#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Power of adaptive global damping over the rate of kinetic energy for a ratio of 1; calibrated on logs of 3DEC, docs/theory/damping.md.
constexpr double global_damping_scale = 4.6;
/// Rate of change of the viscosity in a largest stable step, and its greatest value, over one in that step; from the same logs, whose step
/// is 0.763 of the largest stable one. In these units the motion does not depend on the step.
constexpr double viscosity_rate = 0.0033, most_viscosity = 1 / 0.763;

double stable_step(const Model& model) { return model.clock.time_step / time_step_fraction(model.settings); }

} // namespace

void start_viscosity(Model& model) {
    if (model.settings.damping == Damping::global && model.clock.global_viscosity == 0)
        model.clock.global_viscosity = most_viscosity / stable_step(model);
}

void adapt_viscosity(Model& model, const MotionSums& motion) {
    if (model.settings.damping != Damping::global) return;
    double& viscosity = model.clock.global_viscosity;
    const double change = std::abs(motion.kinetic - motion.kinetic_before);
    const double rate = viscosity_rate * model.clock.time_step / stable_step(model);
    viscosity *= motion.damped > global_damping_scale * model.settings.global_ratio * change ? 1 - rate : 1 + rate;
    viscosity = std::min(viscosity, most_viscosity / stable_step(model));
}

} // namespace kaya
