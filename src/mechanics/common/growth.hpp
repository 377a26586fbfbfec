// When the time step may become longer.
#pragma once

#include "model/tables/settings.hpp"

#include <cstdint>

namespace kaya {

/// Cycles between two checks whether the time step may grow; it is reduced at once when it must be.
constexpr std::int64_t growth_interval = 100;

/// Whether the time step may grow at the end of this cycle.
inline bool step_may_grow(const Clock& clock) { return (clock.cycle + 1) % growth_interval == 0; }

} // namespace kaya
