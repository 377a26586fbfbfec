// What the program does with decks besides running them.
#pragma once

#include "commands/session.hpp"

#include <string>
#include <vector>

namespace kaya {

/// `kaya help`: about a command, a keyword, or a name of FISH or a field of Lua. Throws Diagnostic when it is none.
std::string help_text(const std::string& words);

enum class Formatting { show, write, check };

/// `kaya fmt`: shows decks in their long form, writes it into the files, or names those that are not in it. Gives the exit
/// status.
int format_decks(const std::vector<std::string>& decks, Formatting what, Output& output);

} // namespace kaya
