// One step of the components of a body's velocity, and the account of its energy.
#pragma once

#include "mechanics/motion/damping.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "model/measure/roller.hpp"

#include <cstdint>

namespace kaya {

/// Three components in a vector register; the fourth is 0.
inline Lanes lanes(const Vec3& v) { return LaneGroup(3).load(v.data()); }
inline void store(Vec3& v, const Lanes& lanes) { LaneGroup(3).store(v.data(), lanes); }

/// The sums of MotionSums, lane by lane: lanes are the components of one body, or components of eight.
template <class L> struct MotionSumsIn {
    L kinetic_before{}, kinetic{};
    L gravity{}, boundary{}, damped{};
    L inner_power{}, inner_power_size{}, inner_power_gain{};

    /// Power of a force of joints and zones at the velocities before and after the step.
    void add_power(const L& force, const L& before, const L& after) {
        const L power = force * before;
        inner_power += power;
        inner_power_size += size_of(power);
        inner_power_gain += force * (after - before);
    }
    MotionSums sums() const {
        return {sum(kinetic_before), sum(kinetic),     sum(gravity),          sum(boundary),
                sum(damped),         sum(inner_power), sum(inner_power_size), sum(inner_power_gain)};
    }
};
using MotionLanes = MotionSumsIn<Lanes>;
using MotionEights = MotionSumsIn<Eight>;

/// Components that are prescribed are 1, others 0. `bits` has one for each, the lowest for x.
inline Lanes prescribed(unsigned bits) {
    alignas(32) static constexpr double of[8][lane_count] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0},
                                                             {0, 0, 1, 0}, {1, 0, 1, 0}, {0, 1, 1, 0}, {1, 1, 1, 0}};
    return load_as<Lanes>(of[bits & 7u]);
}

/// The force of a roller that leaves a resultant along its free direction. Combined damping is proportional to the force and must not see
/// the supported part: that is the greater one, and the gridpoint would never come to rest.
inline Vec3 support_against(const Vec3& force, const Roller& roller, unsigned held_bits) {
    Vec3 free = force;
    for (int k = 0; k < 3; ++k)
        if (held_bits & (1u << k)) free[k] = 0;
    return roller_change(roller, free, static_cast<std::uint8_t>(held_bits), Vec3::Zero());
}

/// Advances a velocity by force, load and weight over a step. A roller, if there is one, keeps it on its free direction; the work of its
/// reaction is the boundary's.
inline void advance_velocity(Vec3& velocity, const Vec3& force, const Vec3& load, const Lanes& weight, double mass,
                             double step, unsigned held_bits, const DampingFactors& damping, Vec3& last_force,
                             MotionLanes& sums, const Roller* roller = nullptr) {
    const Lanes before = lanes(velocity), loads = lanes(load), inner = lanes(force), whole = inner + loads + weight;
    Lanes support{};
    if (roller != nullptr && damping.combined != 0) {
        Vec3 sum;
        store(sum, whole);
        support = lanes(support_against(sum, *roller, held_bits));
    }
    // A held component needs no mass.
    Lanes after = damping.advance(before, whole + support, mass > 0 ? step / mass : 0, last_force);
    support *= step;
    const Lanes held = prescribed(held_bits);
    if (held_bits != 0)
        for (int k = 0; k < lane_count; ++k) after[k] = held[k] != 0 ? before[k] : after[k];
    store(velocity, after);
    if (roller != nullptr) {
        const Vec3 change = roller_change(*roller, velocity, static_cast<std::uint8_t>(held_bits), roller->speed);
        velocity += change;
        support += mass * lanes(change);
        after = lanes(velocity);
    }
    sums.add_power(inner, before, after);
    const Lanes mean = 0.5 * (before + after);
    sums.gravity += weight * mean * step;
    // The change of momentum that the step's forces do not explain comes from the support or from damping.
    Lanes rest = (mass * (after - before) - whole * step) * mean;
    if (roller != nullptr) {
        rest -= support * mean;
        sums.boundary += support * mean;
    }
    sums.boundary += loads * mean * step + held * rest;
    sums.damped -= (1 - held) * rest;
    sums.kinetic_before += 0.5 * mass * before * before;
    sums.kinetic += 0.5 * mass * after * after;
}

} // namespace kaya
