// The parts of the machine that libraries of functions use: each gets the part that it needs from the Lua state that calls it.
#pragma once

#include "lang/script/lua_headers.hpp"
#include "lang/script/tables.hpp"
#include "lang/script/world.hpp"

#include <string>

namespace kaya::script {

class Random;
struct OpenFile;
struct Machine;
struct Options;

World& world_of(lua_State* L);
const Options& options_of(lua_State* L);
Tables& tables_of(lua_State* L);
Random& random_of(lua_State* L);
OpenFile& file_of(lua_State* L);
/// While a state is restored, Lua chunks run for their definitions only: functions that write or print do nothing.
bool is_restoring(lua_State* L);
/// Whether the value is an array of FISH, with one dimension or more.
bool is_array(lua_State* L, int index);
/// Pushes a function that translated FISH calls.
void push_runtime(lua_State* L, const char* function);
/// Writes one line to the user.
void print_line(lua_State* L, const std::string& line);

/// The state to which a library adds its functions.
lua_State* state_of(Machine& machine);

} // namespace kaya::script
