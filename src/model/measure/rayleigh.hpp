// Rayleigh damping: the damping matrix is a part of the mass and a part of the stiffness. Equations:
// docs/theory/damping.md.
#pragma once

#include "model/tables/settings.hpp"

#include <numbers>

namespace kaya {

inline double rayleigh_angular_frequency(const Settings& settings) {
    return 2 * std::numbers::pi * settings.rayleigh_frequency;
}

/// Both parts share the damping at the given frequency; one alone has all of it there.
inline double rayleigh_share(const Settings& settings) {
    return settings.rayleigh_mass && settings.rayleigh_stiffness ? 1 : 2;
}

/// Part of the stiffness, time; 0 when it does not act.
inline double stiffness_damping(const Settings& settings) {
    if (settings.damping != Damping::rayleigh || !settings.rayleigh_stiffness || settings.rayleigh_fraction == 0)
        return 0;
    return rayleigh_share(settings) * settings.rayleigh_fraction / rayleigh_angular_frequency(settings);
}

/// Part of the mass, 1/time; 0 when it does not act.
inline double mass_damping(const Settings& settings) {
    if (settings.damping != Damping::rayleigh || !settings.rayleigh_mass) return 0;
    return rayleigh_share(settings) * settings.rayleigh_fraction * rayleigh_angular_frequency(settings);
}

/// True when joints carry viscous forces in addition to those of their law.
inline bool joints_are_damped(const Settings& settings) {
    return settings.contact_damping > 0 || stiffness_damping(settings) > 0;
}

} // namespace kaya
