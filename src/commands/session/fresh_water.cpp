#include "commands/session/fresh_water.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

double density_of_fresh_water(const Session& session, const Place& place) {
    constexpr double fresh = 1000; // kg/m^3
    const Units& units = session.deck.units;
    const double there = fresh / units.density_in_si(1);
    if (std::abs(there / fresh - 1) > 0.01)
        throw Diagnostic(fmt::format("water without a density has {:g}, which is not that of water in the units {}",
                                     fresh, units.name()),
                         fmt::format("give it: density {:.4g}", there))
            .at(place);
    return fresh;
}

} // namespace kaya
