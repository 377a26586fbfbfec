// All names that scripts know without a definition.
#pragma once

#include "lang/script/base/lua_headers.hpp"

namespace kaya::script {

/// Opens them in a new state, in an order: later ones use earlier ones.
void open_libraries(lua_State* L);

} // namespace kaya::script
