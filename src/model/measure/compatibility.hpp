// Conventions of 3DEC: `set compatibility 3dec`.
#pragma once

#include "model/tables/settings.hpp"

#include <limits>

namespace kaya {

/// The Settings::given_time_step that asks for these conventions.
constexpr double step_of_3dec_wanted = -1;

/// The time step is that of 3DEC where it is shorter, and new rigid blocks ask for joints that stand on their corners.
inline bool as_3dec(const Settings& settings) { return settings.given_time_step < 0; }

/// Blocks::face_edge of a rigid block whose joints have sub-contacts at their corners only: they are infinitely far apart.
constexpr double at_corners_only = std::numeric_limits<double>::infinity();

} // namespace kaya
