// Damping of one degree of freedom; equations in docs/theory/damping.md.
#pragma once

#include "mechanics/contact/dashpots.hpp"
#include "mechanics/lanes/eight.hpp"
#include "model/tables/lanes.hpp"
#include "model/tables/settings.hpp"

#include <cmath>

namespace kaya {

/// Damping factors of a step, derived from the settings.
struct DampingFactors {
    double local = 0;    ///< alpha of F_d = -alpha |F| sgn(v)
    double combined = 0; ///< alpha of F_d = alpha |F| (sgn(dF/dt) - sgn(v))/2
    double viscous = 0;  ///< of F_d = -viscous m v, 1/time

    DampingFactors(const Settings& settings, const Clock& clock) {
        if (settings.damping == Damping::local) local = settings.local_factor;
        if (settings.damping == Damping::combined) combined = settings.local_factor;
        if (settings.damping == Damping::global) viscous = clock.global_viscosity;
        if (settings.damping == Damping::rayleigh) viscous = mass_damping(settings);
        if (settings.damping == Damping::global)
            viscous = std::fmin(viscous, 1 / clock.time_step); // the step may have grown
        half_ = 0.5 * viscous * clock.kick();
        after_turn_ = (1 - local) / (1 + local);
    }

    /// Velocities one step later, from the sums of forces and step over mass (or moments, and step over moment of inertia). `last` is the
    /// sum of forces of the previous step; combined damping reads and updates it. Viscous damping is centred and stable for any viscosity.
    /// Local damping changes sign with the velocity: where that happens within a step, the rest of the step uses the other sign; otherwise
    /// strongly damped motion would turn several steps early.
    Lanes advance(const Lanes& velocity, const Lanes& force, double step_over_mass, Vec3& last) const {
        const Lanes push = force * step_over_mass;
        if (combined != 0) {
            Lanes next = velocity;
            for (int k = 0; k < 3; ++k) next[k] = advance_combined(velocity[k], force[k], push[k], last[k]);
            return next;
        }
        if (local == 0) return (velocity * (1 - half_) + push) / (1 + half_);
        // Branch-free selections: the signs of a body at rest are noise.
        Lanes next;
        const double more = 1 + local, less = 1 - local, turned = after_turn_;
        for (int k = 0; k < lane_count; ++k) {
            const bool against = velocity[k] * push[k] < 0;
            const double first = velocity[k] + (against ? more : less) * push[k];
            next[k] = (against & (first * velocity[k] < 0)) ? first * turned : first;
        }
        return next;
    }

    /// The same for eight components.
    Eight advance(const Eight& velocity, const Eight& force, const Eight& push, double* last) const {
        if (combined == 0) return advance(velocity, push);
        const Eight change = force - load_as<Eight>(last);
        store(last, force);
        return advance_combined(velocity, size_of(change) > steady * size_of(force) ? change : Eight{}, push);
    }
    /// Without combined damping.
    Eight advance(const Eight& velocity, const Eight& push) const {
        if (local == 0) return (velocity * (1 - half_) + push) / (1 + half_);
        const Eight first = velocity + (velocity * push < 0 ? eights(1 + local) : eights(1 - local)) * push;
        return ((velocity * push < 0) & (first * velocity < 0)) ? first * after_turn_ : first;
    }

private:
    /// A force that changes by less of itself in a step does not change: the sign of what is left is rounding.
    static constexpr double steady = 1e-9;

    /// advance_combined for one component.
    Eight advance_combined(const Eight& velocity, const Eight& change, const Eight& push) const {
        const Eight none{}, brake = 0.5 * combined * size_of(push), with = velocity < 0 ? -brake : brake;
        const Eight acting = push + (change == 0 ? none : change < 0 ? -brake : brake);
        const Eight less = acting - brake, more = acting + brake;
        const Eight from_rest = acting > 0 ? (less > 0 ? less : none) : (more < 0 ? more : none);
        const Eight against = acting - with, next = velocity + against;
        const Eight after = (1 + velocity / against) * (acting + with), turned = after * velocity < 0 ? after : none;
        return velocity == 0 ? from_rest : next * velocity >= 0 ? next : turned;
    }

    double half_ = 0;       ///< part of the momentum that viscous damping removes in a step
    double after_turn_ = 1; ///< local damping: the part of a velocity that remains when it changes sign

    double advance_combined(double velocity, double force, double push, double& last) const {
        const double change = std::abs(force - last) > steady * std::abs(force) ? force - last : 0;
        last = force;
        const double brake = 0.5 * combined * std::abs(push);
        const double acting = push + (change == 0 ? 0 : std::copysign(brake, change));
        if (velocity == 0) return acting > 0 ? std::fmax(acting - brake, 0) : std::fmin(acting + brake, 0);
        const double against = acting - std::copysign(brake, velocity);
        const double next = velocity + against;
        if (next * velocity >= 0) return next;
        // The velocity changes sign within the step: damping reverses for the rest of it.
        const double rest = 1 + velocity / against;
        const double after = rest * (acting + std::copysign(brake, velocity));
        return after * velocity < 0 ? after : 0;
    }
};

} // namespace kaya
