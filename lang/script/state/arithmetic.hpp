// Arithmetic where FISH differs from Lua, arithmetic of vectors, and messages about invalid operands.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// Adds __add, __lt, ... to the metatable at the top: each reports the two values that cannot be combined.
void add_refusing_arithmetic(lua_State* L);
/// Changes the type of texts: in FISH `+` joins them; a Lua chunk keeps the behaviour of Lua.
void open_text_arithmetic(lua_State* L);
/// Makes the type of vectors; leaves nothing on the stack.
void open_vectors(lua_State* L);
/// divide, power, step, whole into the table at the top (R of translated FISH).
void add_runtime_arithmetic(lua_State* L);

} // namespace kaya::script
