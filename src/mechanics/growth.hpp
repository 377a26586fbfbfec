// When the time step may become longer.
#pragma once

#include "model/settings.hpp"

#include <cstdint>

namespace kaya {

/// Cycles between two looks at whether the time step may grow again; a step that must shrink does at once.
constexpr std::int64_t growth_interval = 100;

/// Whether the time step may grow when this cycle ends.
inline bool step_may_grow(const Clock& clock) { return (clock.cycle + 1) % growth_interval == 0; }

} // namespace kaya
