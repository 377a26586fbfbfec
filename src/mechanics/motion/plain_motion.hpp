// Velocities of eight bodies held by fixities only, one step on, with their energy account; for each component the same operations as
// advance_velocity (motion.hpp).
#pragma once

#include "mechanics/motion/motion.hpp"

namespace kaya {

class PlainMotion {
public:
    explicit PlainMotion(const Model& model)
        : damping_(model.settings, model.clock), gravity_(for_each_row(model.settings.gravity)),
          kick_(model.clock.kick()) {}

    bool is_combined() const { return damping_.combined != 0; }

    /// Eight rows of a table of bodies: their forces and their velocities before the step.
    struct Rows {
        const Vec3 &velocity, &force, &load;
        const double &mass, &inertial_mass;
        Vec3& last_force; ///< for combined damping
    };

    /// Velocities after the step.
    [[gnu::always_inline]] ThreeEights advance(const Rows& rows) { return advance_by<false>(rows, {}); }
    /// Components with 1 in `held` keep theirs.
    [[gnu::always_inline]] ThreeEights advance(const Rows& rows, const ThreeEights& held) {
        return advance_by<true>(rows, held);
    }

    /// Angular momenta after the step, of bodies that may turn freely.
    [[gnu::always_inline]] ThreeEights advance_momentum(const ThreeEights& momentum, const ThreeEights& moment) const {
        ThreeEights after;
        for (std::size_t i = 0; i < 3; ++i) after[i] = damping_.advance(momentum[i], moment[i] * kick_);
        return after;
    }

    double kick() const { return kick_; }

    MotionEights sums;

private:
    template <bool some_held> [[gnu::always_inline]] ThreeEights advance_by(const Rows& rows, const ThreeEights& held) {
        const ThreeEights before = load_three(rows.velocity.data()), inner = load_three(rows.force.data()),
                          load = load_three(rows.load.data());
        const Eight inertial = load_as<Eight>(&rows.inertial_mass);
        const ThreeEights mass = for_each_of_three(inertial),
                          weight_mass = for_each_of_three(load_as<Eight>(&rows.mass)),
                          step_over_mass = for_each_of_three(kick_ / inertial);
        ThreeEights after;
        for (std::size_t i = 0; i < 3; ++i) {
            const Eight weight = weight_mass[i] * gravity_[i], whole = inner[i] + load[i] + weight;
            after[i] =
                damping_.advance(before[i], whole, whole * step_over_mass[i], rows.last_force.data() + eight * i);
            if constexpr (some_held) after[i] = held[i] != 0 ? before[i] : after[i];
            sums.add_power(inner[i], before[i], after[i]);
            const Eight mean = 0.5 * (before[i] + after[i]);
            sums.gravity += weight * mean * kick_;
            const Eight rest = (mass[i] * (after[i] - before[i]) - whole * kick_) * mean;
            if constexpr (some_held) {
                sums.boundary += load[i] * mean * kick_ + held[i] * rest;
                sums.damped -= (1 - held[i]) * rest;
            } else {
                sums.boundary += load[i] * mean * kick_;
                sums.damped -= rest;
            }
            sums.kinetic_before += 0.5 * mass[i] * before[i] * before[i];
            sums.kinetic += 0.5 * mass[i] * after[i] * after[i];
        }
        return after;
    }

    const DampingFactors damping_;
    const ThreeEights gravity_;
    const double kick_;
};

/// Adds a shift of three components to each of eight rows.
inline void add_shift(Vec3& rows, const ThreeEights& shift) {
    ThreeEights sum = load_three(rows.data());
    for (std::size_t i = 0; i < 3; ++i) sum[i] += shift[i];
    store(rows.data(), sum);
}

} // namespace kaya
