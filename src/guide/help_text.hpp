// Help from all tables: commands, FISH, fields.
#pragma once

#include "base/units.hpp"

#include <string>

namespace kaya {

/// About a command, a keyword, or a name of FISH or a field of Lua; without words the list of commands. Throws Diagnostic when it is none.
std::string help_text(const std::string& words);

/// The same text with units for the quantities at the ends of its lines, if there is a system of units: "density of blocks [kg/m^3]".
std::string help_with_units(const std::string& help, const Units& units);

} // namespace kaya
