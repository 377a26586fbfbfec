#include "model/settings.hpp"

namespace kaya {

double time_step_fraction(const Settings& settings) {
    if (settings.time_step_fraction > 0) return settings.time_step_fraction;
    // Little local damping is given by those who follow motion.
    constexpr double weak = 0.3;
    const bool local = settings.damping == Damping::local && settings.local_factor >= weak;
    const bool to_rest = local || settings.damping == Damping::global || settings.damping == Damping::combined;
    if (to_rest) return 0.75;
    // Where nothing damps, a blow must give back what it has taken to a thousandth.
    const bool undamped = settings.damping == Damping::none && settings.contact_damping == 0;
    return undamped ? 0.05 : 0.25;
}

} // namespace kaya
