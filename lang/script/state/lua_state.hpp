// The Lua state: the model that it works on, its permissions, its memory, its output, and the calls that are open.
#pragma once

#include "lang/script/base/lua_headers.hpp"
#include "lang/script/base/options.hpp"
#include "lang/script/base/source_list.hpp"
#include "lang/script/state/owners.hpp"
#include "lang/script/values/world.hpp"

#include <cstddef>
#include <functional>
#include <string>

namespace kaya::script {

/// Memory that scripts use, where it is limited.
struct Memory {
    std::size_t used = 0, limit = 0;
};

struct LuaState {
    /// The state alone: open_libraries gives it the names that scripts know.
    LuaState(World& the_world, Options the_options, const Owners& owners);
    ~LuaState();
    LuaState(const LuaState&) = delete;
    LuaState& operator=(const LuaState&) = delete;

    lua_State* lua = nullptr;
    World& world;
    Options options;
    Memory memory;
    SourceList sources;

    std::function<void(const std::string&)> sink;
    std::string unfinished_line; ///< of io.write

    int depth = 0;          ///< calls into Lua that are open
    int levels_before = 0;  ///< stack levels of Lua that belong to outer calls
    int awaited = 0;        ///< commands and cycles that wait for a value from a script
    bool stopping = false;  ///< requested by the user; until the outermost call has ended
    bool restoring = false; ///< Lua chunks run for their definitions only: functions that write or print do nothing

    // References to values in Lua's registry.
    int environment = LUA_NOREF; ///< global variables of the user's Lua
    int runtime = LUA_NOREF;     ///< R: functions that translated FISH calls
    int vector_type = LUA_NOREF;
    int diagnostic_type = LUA_NOREF;
    // Addresses of metatables, for quick tests.
    const void* vector_address = nullptr;
    const void* array_address = nullptr; ///< of arrays with one dimension
    const void* grid_address = nullptr;  ///< of arrays with more
};

inline LuaState& state_of(lua_State* L) { return *owners_of(L).state; }
inline World& world_of(lua_State* L) { return state_of(L).world; }
inline const Options& options_of(lua_State* L) { return state_of(L).options; }
inline bool is_restoring(lua_State* L) { return state_of(L).restoring; }

inline void push_anchor(lua_State* L, int anchor) { lua_rawgeti(L, LUA_REGISTRYINDEX, anchor); }
/// Pushes a function that translated FISH calls.
void push_runtime(lua_State* L, const char* function);
/// Whether the value is an array of FISH, with one dimension or more.
bool is_array(lua_State* L, int index);
/// Writes one line to the user.
void print_line(lua_State* L, const std::string& line);

} // namespace kaya::script
