// The Lua state and its surroundings. Shared by the files of this folder, and internal to it.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/script/field_index.hpp"
#include "lang/script/fish_names.hpp"
#include "lang/script/lua_headers.hpp"
#include "lang/script/open_file.hpp"
#include "lang/script/options.hpp"
#include "lang/script/random.hpp"
#include "lang/script/source_list.hpp"
#include "lang/script/tables.hpp"
#include "lang/script/traversal.hpp"
#include "lang/script/world.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace kaya::script {

/// References to values in Lua's registry.
struct Anchors {
    int globals = LUA_NOREF;     ///< G: values of FISH variables
    int functions = LUA_NOREF;   ///< F: FISH functions and, wrapped, Lua functions
    int readers = LUA_NOREF;     ///< A: built-ins that read
    int writers = LUA_NOREF;     ///< W: built-ins that write
    int runtime = LUA_NOREF;     ///< R: functions that translated FISH calls
    int extras = LUA_NOREF;      ///< "b_extra" -> handle -> value
    int environment = LUA_NOREF; ///< global variables of the user's Lua
    int library = LUA_NOREF;     ///< names for every Lua chunk: contacts, math, hook, ...
    int methods = LUA_NOREF;     ///< contact -> sub_contacts -> function
    int modules = LUA_NOREF;     ///< values of `require`, by name
    int vector_type = LUA_NOREF;
    int diagnostic_type = LUA_NOREF;
    int names = LUA_NOREF; ///< keeps the field names alive, whose addresses are compared
};

struct Hook {
    Moment moment = Moment::after_cycle;
    std::int64_t interval = 1;
    int function = LUA_NOREF;
};

/// Memory that scripts use, where it is limited.
struct Memory {
    std::size_t used = 0, limit = 0;
};

struct Machine {
    /// The state alone: open_libraries gives it the names that scripts know.
    Machine(World& the_world, Options the_options);
    ~Machine();
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    lua_State* lua = nullptr;
    World& world;
    Options options;
    Memory memory;
    Anchors anchors;
    const void* vector_type = nullptr; ///< address of the metatable, for a quick test
    const void* array_type = nullptr;  ///< of arrays with one dimension
    const void* grid_type = nullptr;   ///< of arrays with more
    FieldIndex fields;
    std::vector<std::size_t> next_relations; ///< by table number: from an object to the next one of its list
    std::vector<Traversal> traversals;
    FishLibrary fish;
    SourceList sources;
    std::vector<Hook> hooks;
    int lua_histories = 0;
    Tables tables;
    Random random;
    OpenFile file;
    std::function<void(const std::string&)> sink;
    std::string unfinished_line;                                      ///< of io.write
    std::filesystem::path script_folder;                              ///< of the present deck: searched by `require`
    std::function<std::vector<std::filesystem::path>()> deck_folders; ///< of the running file and its callers

    /// While a state is restored, Lua chunks run for their definitions only.
    bool restoring = false;
    bool stopping = false;   ///< requested by the user; until the outermost call has ended
    int depth = 0;           ///< calls into Lua that are open
    int awaited = 0;         ///< commands and cycles that wait for a value from a script
    int levels_before = 0;   ///< stack levels of Lua that belong to outer calls
    bool registered = false; ///< a chunk registered a hook or a history: it must be stored
};

/// The machine that a Lua state belongs to.
inline Machine& machine_of(lua_State* L) { return **static_cast<Machine**>(lua_getextraspace(L)); }

inline void push_anchor(lua_State* L, int anchor) { lua_rawgeti(L, LUA_REGISTRYINDEX, anchor); }

/// Writes one line to the user.
void print_line(Machine& machine, const std::string& line);

} // namespace kaya::script
