// R, the functions that translated FISH calls: see the foot of lang/fish/compiler.hpp.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

void open_runtime(lua_State* L);

} // namespace kaya::script
