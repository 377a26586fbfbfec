// Lists, maps, tensors and structures of FISH, written in Lua: stdlib/lua/fish_values.lua, and the functions on them,
// stdlib/lua/fish_functions.lua and fish_matrices.lua.
#pragma once

#include "lang/script/lua_headers.hpp"
#include "lang/script/world.hpp"

#include <string>

namespace kaya::script {

struct Machine;

/// Adds what translated FISH needs for these values to the table at the top of the stack.
void open_values(Machine& machine);
/// list.append, map.keys, string.split, ...: comes after the classic names, which some of them call.
void add_value_functions(Machine& machine);

/// "list", "map", "tensor", "structure"; empty for other values.
std::string kind_of_value(lua_State* L, int index);
/// Such a value for the program, and back.
Value compound_at(lua_State* L, int index, const std::string& kind);
void push_compound(lua_State* L, const Compound& compound);
/// What FISH prints for such a value.
std::string text_of_value(lua_State* L, int index);

} // namespace kaya::script
