// Values of FISH that hold others: lists, maps, tensors, matrices, structures. Their types are written in Lua, in
// stdlib/lua/fish_values.lua.
#pragma once

#include "lang/script/base/lua_headers.hpp"
#include "lang/script/values/world.hpp"

#include <string>

namespace kaya::script {

/// "list", "map", "tensor", "structure"; empty for other values.
std::string kind_of_value(lua_State* L, int index);
/// Such a value for the program, and back.
Value compound_at(lua_State* L, int index, const std::string& kind);
void push_compound(lua_State* L, const Compound& compound);
/// The text that FISH prints for such a value.
std::string text_of_value(lua_State* L, int index);

} // namespace kaya::script
