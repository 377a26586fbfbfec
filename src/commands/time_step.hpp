// What users are told of the time step.
#pragma once

#include "commands/session.hpp"

namespace kaya {

/// Warns, once in a session, of a step from the deck that is longer than what is surely stable. The model must be prepared.
void warn_of_long_step(Session& session);

/// Says once that cycles are counted while something moves at a velocity that the deck gives.
void note_counted_cycles(Session& session);

} // namespace kaya
