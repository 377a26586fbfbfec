// Functions for Lua chunks of a deck beyond Lua itself: stdlib/lua/library.lua and the functions that it calls.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// Makes the library and the table of the user's global variables.
void open_library(lua_State* L);

} // namespace kaya::script
