// The names that a joint model in Lua may use, and those that it must not change. Internal to this folder.
#pragma once

#include <initializer_list>
#include <string_view>

struct lua_State;

namespace kaya::script {

/// Restricts the table on the stack to its present names: reading or setting another one raises an error with a proposal. `noun` is its
/// name in messages.
void close_names(lua_State* L, const char* noun);

/// Pushes a read-only view of the table on the stack.
void push_view(lua_State* L, const char* noun);

/// Throws std::runtime_error for a name that a table of the user must not have: it is a slip of the pen.
void refuse_other_names(lua_State* L, std::string_view of, std::initializer_list<std::string_view> known);

/// Pushes a function of the chunk of a file, its globals, the table that it has returned and the library `debug`. Upvalues of functions of
/// the file, and the globals, become read-only. It returns a function that restores a variable which was changed nevertheless, and returns
/// its name.
void push_freezer(lua_State* L);

} // namespace kaya::script
