#include "model/measure/time_step_fraction.hpp"

namespace kaya {

double time_step_fraction(const Settings& settings) {
    if (settings.time_step_fraction > 0) return settings.time_step_fraction;
    // Weaker local damping is used for motion that is to be followed.
    constexpr double weak = 0.3;
    const bool local = settings.damping == Damping::local && settings.local_factor >= weak;
    const bool to_rest = local || settings.damping == Damping::global || settings.damping == Damping::combined;
    if (to_rest) return 0.75;
    // Without damping, an impact must return the energy it took to a thousandth.
    const bool undamped = settings.damping == Damping::none && settings.contact_damping == 0;
    return undamped ? 0.05 : 0.25;
}

} // namespace kaya
