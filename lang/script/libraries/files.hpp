// Files of Lua: its own io.open does not query the gate.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// (name, mode of fopen): fails when the script may not open that file.
int require_file(lua_State* L);
/// (name, mode of fopen): a file as Lua's own io.open gives it.
int open_file(lua_State* L);

} // namespace kaya::script
