// What users are told of the time step.
#pragma once

#include "commands/session.hpp"

#include <string>

namespace kaya {

/// Warns, once in a session, of a step from the deck that is longer than what is surely stable. The model must be prepared.
void warn_of_long_step(Session& session);

/// Says once that cycles are counted while something moves at a velocity that the deck gives.
void note_counted_cycles(Session& session);

/// What mass longer steps take, with what `mscale part` needs for them; empty when nothing is elastic. The model must be prepared.
std::string added_mass_table(const Model& model);

/// Says once that little mass would let the step be far longer, where nothing is driven and true masses count for nothing.
/// The model must be prepared.
void note_added_mass(Session& session);

} // namespace kaya
