#include "model/measure/time_step_fraction.hpp"

namespace kaya {

bool damps_to_rest(const Settings& settings) {
    constexpr double weak = 0.3;
    return (settings.damping == Damping::local && settings.local_factor >= weak) ||
           settings.damping == Damping::global || settings.damping == Damping::combined;
}

double time_step_fraction(const Settings& settings) {
    if (settings.time_step_fraction > 0) return settings.time_step_fraction;
    if (damps_to_rest(settings)) return 0.75;
    // Without damping, an impact must return the energy it took to a thousandth.
    const bool undamped = settings.damping == Damping::none && settings.contact_damping == 0;
    return undamped ? 0.05 : 0.25;
}

} // namespace kaya
