// The names that a joint model in Lua may use, and what it must not change. Not seen outside of this folder.
#pragma once

#include <initializer_list>
#include <string_view>

struct lua_State;

namespace kaya::script {

/// The table on the stack knows the names that it has now, and no others: reading or setting another one raises with a
/// proposal. `noun` is what messages call it.
void close_names(lua_State* L, const char* noun);

/// Pushes what looks like the table on the stack and can only be read.
void push_view(lua_State* L, const char* noun);

/// Throws std::runtime_error for a name that a table of the user must not have: it is a slip of the pen.
void refuse_other_names(lua_State* L, std::string_view of, std::initializer_list<std::string_view> known);

/// Pushes a function of the chunk of a file, its globals, the table that it has returned and the library `debug`. From then on
/// what functions of the file reach, and the globals, can only be read. It returns a function that says which variable was
/// changed all the same, after putting it back.
void push_freezer(lua_State* L);

} // namespace kaya::script
