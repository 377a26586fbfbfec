// Notes and tables about the time step.
#pragma once

#include "commands/session/session.hpp"

#include <string>

namespace kaya {

/// Warns, once in a session, when the step of the deck exceeds the stable bound. The model must be prepared.
void warn_of_long_step(Session& session);

/// Warns, once in a session, about a free block that turns by so much in a step that its motion is not resolved.
void warn_of_fast_spin(Session& session);

/// Notes once that cycles are counted while a boundary moves at a velocity given by the deck.
void note_counted_cycles(Session& session);

/// The added mass that longer steps need, with the arguments of `mscale part`; empty when nothing is elastic. The model must be prepared.
std::string added_mass_table(const Model& model);

/// Notes once that a little added mass would allow a much longer step, where nothing is driven and true masses do not matter. The model
/// must be prepared.
void note_added_mass(Session& session);

} // namespace kaya
