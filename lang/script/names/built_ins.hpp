// Adds names that FISH knows without a definition to the tables A and W.
#pragma once

#include "lang/script/base/lua_headers.hpp"

#include <span>
#include <string_view>

namespace kaya::script {

/// One row of a table of built-ins. Both functions are wrapped by `guarded`.
struct BuiltInFunction {
    const char* name;
    int least, most; ///< arguments when it is read
    lua_CFunction read;
    lua_CFunction write = nullptr; ///< arguments, then the value; null: read only
};

void add_built_ins(lua_State* L, std::span<const BuiltInFunction> functions);
/// Takes the function at the top of the stack as reader or writer of `name`.
void add_reader(lua_State* L, std::string_view name, int least, int most);
void add_writer(lua_State* L, std::string_view name);

} // namespace kaya::script
