// Help from all tables: commands, FISH, fields.
#pragma once

#include "base/units.hpp"

#include <string>

namespace kaya {

/// About a command, a keyword, or a name of FISH or a field of Lua; without words the list of commands. Throws Diagnostic when it is none.
/// Quantities are named by `units`: "density of blocks [kg/m^3]".
std::string help_text(const std::string& words, const Units& units = {});

} // namespace kaya
