// Damping of one degree of freedom; equations in docs/theory/damping.md.
#pragma once

#include "model/settings.hpp"

#include <cmath>

namespace kaya {

/// What the settings mean for a step: factors that loops use.
struct DampingFactors {
    double local = 0;   ///< alpha of F_d = -alpha |F| sgn(v)
    double viscous = 0; ///< of F_d = -viscous m v, 1/time

    explicit DampingFactors(const Settings& settings, const Clock& clock) {
        if (settings.damping == Damping::local || settings.damping == Damping::combined)
            local = settings.local_factor;
        if (settings.damping == Damping::global) viscous = clock.global_viscosity;
        if (settings.damping == Damping::rayleigh && settings.rayleigh_mass)
            viscous = 4 * 3.14159265358979323846 * settings.rayleigh_fraction * settings.rayleigh_frequency;
    }

    /// The velocity half a step later, from the sum of forces and the mass (or moment and moment of
    /// inertia). Viscous damping is centred, so it is stable for any viscosity.
    double advance(double velocity, double force, double mass, double step) const {
        if (local != 0) {
            const double sign = velocity > 0 ? 1.0 : velocity < 0 ? -1.0 : 0.0;
            force -= local * std::abs(force) * sign;
        }
        const double half = 0.5 * viscous * step;
        return (velocity * (1 - half) + force / mass * step) / (1 + half);
    }
};

} // namespace kaya
