// What the program does with decks besides running them.
#pragma once

#include "commands/session.hpp"

#include <string>
#include <vector>

namespace kaya {

/// `kaya help`: about a command, a keyword, or a name of FISH or a field of Lua. Throws Diagnostic when it is none.
std::string help_text(const std::string& words);

/// `kaya fmt`: shows decks in their long form, or writes it into the files. Gives the exit status.
int format_decks(const std::vector<std::string>& decks, bool in_place, Output& output);

} // namespace kaya
