// The density of water that a deck does not give.
#pragma once

#include "commands/session/session.hpp"

namespace kaya {

/// 1000. Throws Diagnostic where `set units` has units in which that is not the density of water.
double density_of_fresh_water(const Session& session, const Place& place);

} // namespace kaya
