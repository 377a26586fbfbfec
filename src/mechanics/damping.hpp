// Damping of one degree of freedom; equations in docs/theory/damping.md.
#pragma once

#include "model/settings.hpp"

#include <cmath>
#include <numbers>

namespace kaya {

/// What the settings mean for a step: factors that loops use.
struct DampingFactors {
    double local = 0;   ///< alpha of F_d = -alpha |F| sgn(v)
    double viscous = 0; ///< of F_d = -viscous m v, 1/time

    explicit DampingFactors(const Settings& settings, const Clock& clock) {
        if (settings.damping == Damping::local || settings.damping == Damping::combined)
            local = settings.local_factor;
        if (settings.damping == Damping::global) viscous = clock.global_viscosity;
        if (settings.damping == Damping::rayleigh)
            viscous = 4 * std::numbers::pi * settings.rayleigh_fraction * settings.rayleigh_frequency;
    }

    /// The velocity one step later, from the sum of forces and the mass (or moment and moment of inertia).
    /// Viscous damping is centred, so it is stable for any viscosity. Local damping turns round with the
    /// velocity: where that happens inside a step, the rest of the step sees the other sign; without this
    /// strongly damped motion would turn several steps too early.
    double advance(double velocity, double force, double mass, double step) const {
        const double half = 0.5 * viscous * step;
        const double push = force / mass * step;
        if (local == 0) return (velocity * (1 - half) + push) / (1 + half);
        const bool against = velocity * push < 0;
        double next = velocity + (against ? 1 + local : 1 - local) * push;
        if (against && next * velocity < 0) next *= (1 - local) / (1 + local);
        return (next - half * velocity) / (1 + half);
    }
};

} // namespace kaya
