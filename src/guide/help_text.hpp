// Help from all tables: commands, FISH, fields.
#pragma once

#include <string>

namespace kaya {

/// About a command, a keyword, or a name of FISH or a field of Lua; without words the list of commands. Throws Diagnostic when it is none.
std::string help_text(const std::string& words);

} // namespace kaya
