// Lists, maps, tensors and structures of FISH, written in Lua: stdlib/lua/fish_values.lua, and the functions on them in the other files
// whose names begin with fish_.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// Adds what translated FISH needs for these values to the table at the top of the stack.
void open_values(lua_State* L);
/// list.append, map.keys, string.split, ...: comes after the classic names, which some of them call.
void add_value_functions(lua_State* L);

} // namespace kaya::script
