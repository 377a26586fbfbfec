// What stdlib/lua/library.lua calls of the program, by subject.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

// Each adds its functions to the table at the top of the stack.
void add_model_natives(lua_State* L);
void add_sample_natives(lua_State* L);
void add_hook_natives(lua_State* L);

} // namespace kaya::script
