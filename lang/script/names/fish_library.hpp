// FISH functions: their definition, and the meanings of their names.
#pragma once

#include "lang/fish/compiler.hpp"

#include <string>
#include <vector>

namespace kaya::script {

/// Present meanings of names; `coming` is a function that is about to be defined.
fish::Dictionary dictionary_of(lua_State* L, const fish::Function* coming = nullptr);

/// Reads and checks the function, then puts it in the place of an older one of its name.
void define_fish_function(lua_State* L, const std::string& text, const Place& place);

/// Leaves the Lua function of the expression on the stack.
void push_expression(lua_State* L, const std::string& expression, const Place& place);
/// Leaves the Lua function of that name on the stack as Lua has it, without what makes its value one of FISH; false when there is none.
bool push_lua_function(lua_State* L, const std::string& name);
/// Where the function at that index begins in a deck; nowhere when it is not of a deck.
Place place_of_function(lua_State* L, int index);
/// `@name(1)` and `[name(1)]` as `name(1)`.
std::string bare_expression(const std::string& expression);

/// The meaning of a name has changed: functions that mention it are translated again at their next call.
void forget_translations(lua_State* L, const std::string& name);
/// Registers a Lua function: FISH can call it by its name in lower case.
void adopt_lua_function(lua_State* L, const std::string& name);

/// Reading fish.name in Lua, and `set @name`; both throw Diagnostic.
void push_fish_name(lua_State* L, const std::string& name);
void set_fish_name(lua_State* L, const std::string& name, int index);

/// All variables and functions, sorted.
std::vector<std::string> fish_symbols(lua_State* L);
bool knows_fish_name(lua_State* L, const std::string& name);

} // namespace kaya::script
