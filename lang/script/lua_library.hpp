// Functions for Lua chunks of a deck beyond Lua itself: stdlib/lua/library.lua and the functions that it calls.
#pragma once

#include <string>

namespace kaya::script {

struct Machine;

/// Makes the library and the table of the user's global variables.
void open_library(Machine& machine);

} // namespace kaya::script
