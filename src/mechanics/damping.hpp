// Damping of one degree of freedom; equations in docs/theory/damping.md.
#pragma once

#include "mechanics/dashpots.hpp"
#include "model/settings.hpp"

#include <cmath>

namespace kaya {

/// What the settings mean for a step: factors that loops use.
struct DampingFactors {
    double local = 0;    ///< alpha of F_d = -alpha |F| sgn(v)
    double combined = 0; ///< alpha of F_d = alpha |F| (sgn(dF/dt) - sgn(v))/2
    double viscous = 0;  ///< of F_d = -viscous m v, 1/time

    explicit DampingFactors(const Settings& settings, const Clock& clock) {
        if (settings.damping == Damping::local) local = settings.local_factor;
        if (settings.damping == Damping::combined) combined = settings.local_factor;
        if (settings.damping == Damping::global) viscous = clock.global_viscosity;
        if (settings.damping == Damping::rayleigh) viscous = mass_damping(settings);
    }

    /// The velocity one step later, from the sum of forces and the mass (or moment and moment of inertia).
    /// `last` is the sum of forces one step ago; combined damping reads it and sets it.
    /// Viscous damping is centred, so it is stable for any viscosity. Local damping turns round with the
    /// velocity: where that happens inside a step, the rest of the step sees the other sign; without this
    /// strongly damped motion would turn several steps too early.
    double advance(double velocity, double force, double mass, double step, double& last) const {
        const double half = 0.5 * viscous * step;
        const double push = force / mass * step;
        if (combined != 0) return advance_combined(velocity, force, push, last);
        if (local == 0) return (velocity * (1 - half) + push) / (1 + half);
        const bool against = velocity * push < 0;
        double next = velocity + (against ? 1 + local : 1 - local) * push;
        if (against && next * velocity < 0) next *= (1 - local) / (1 + local);
        return (next - half * velocity) / (1 + half);
    }

private:
    double advance_combined(double velocity, double force, double push, double& last) const {
        const double change = force - last;
        last = force;
        const double brake = 0.5 * combined * std::abs(push);
        const double drive = push + (change == 0 ? 0 : std::copysign(brake, change));
        if (velocity == 0) return drive > 0 ? std::fmax(drive - brake, 0) : std::fmin(drive + brake, 0);
        const double against = drive - std::copysign(brake, velocity);
        const double next = velocity + against;
        if (next * velocity >= 0) return next;
        // It turns inside the step: the brake pulls the other way for the rest of it.
        const double rest = 1 + velocity / against;
        const double after = rest * (drive + std::copysign(brake, velocity));
        return after * velocity < 0 ? after : 0;
    }
};

} // namespace kaya
