// The behaviour of handles in Lua.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// The type of all handles: fields, methods, text, and errors for arithmetic.
void open_handles(lua_State* L);

} // namespace kaya::script
