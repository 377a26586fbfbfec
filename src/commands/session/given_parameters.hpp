// Parameters that decks are run with, of `--set` and of Python: warnings about those that had no effect.
#pragma once

#include "commands/review/deck_words.hpp"
#include "commands/session/session.hpp"

#include <string>
#include <vector>

namespace kaya {

/// After the run: warns of parameters that the decks replaced and of properties that no command set. `words` are those of the decks; null:
/// unknown.
void warn_of_unused_parameters(Session& session, const std::vector<std::string>& names, const DeckWords* words);

} // namespace kaya
