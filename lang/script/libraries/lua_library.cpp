#include "lang/script/libraries/lua_library.hpp"

#include "lang/script/base/modules.hpp"
#include "lang/script/base/source_list.hpp"
#include "lang/script/libraries/files.hpp"
#include "lang/script/libraries/lua_natives.hpp"
#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/fish_library.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

/// (x, y, z), or nothing: zero
int vector(lua_State* L) {
    const int given = lua_gettop(L);
    if (given != 0 && given != 3)
        throw Diagnostic(
            fmt::format("'vector' takes x, y and z, here it is given {} value{}", given, given == 1 ? "" : "s"),
            "write all three: vector(x, y, z); vector() is zero", Fault::run);
    Vec3 v = Vec3::Zero();
    for (int i = 0; i < given; ++i) v[i] = number_argument(L, i + 1, "vector");
    push_vector(L, v);
    return 1;
}

int read_fish(lua_State* L) {
    push_fish_name(L, text_argument(L, 1, "fish"));
    return 1;
}

int write_fish(lua_State* L) {
    const std::string name = text_argument(L, 1, "fish");
    if (lua_type(L, 2) == LUA_TFUNCTION)
        throw Diagnostic(fmt::format("fish.{} cannot hold a function", name),
                         "FISH can call every global function of Lua by its name", Fault::run);
    set_fish_name(L, name, 2);
    return 0;
}

/// Calls a function of the runtime with the first argument.
int ask_runtime(lua_State* L, const char* function) {
    push_runtime(L, function);
    lua_pushvalue(L, 1);
    lua_call(L, 1, 1);
    return 1;
}

int as_array(lua_State* L) { return ask_runtime(L, "as_array"); }
int is_array(lua_State* L) { return ask_runtime(L, "is_array"); }

/// Numbers for sorting pointers; other userdata are all the same.
int order(lua_State* L) {
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const auto bits = pointer ? reinterpret_cast<std::uintptr_t>(lua_touserdata(L, 1)) : 0;
    lua_pushinteger(L, static_cast<lua_Integer>(bits));
    return 1;
}

int print(lua_State* L) {
    print_line(L, std::exchange(state_of(L).unfinished_line, {}) + text_argument(L, 1, "print"));
    return 0;
}

int write(lua_State* L) {
    for (const char c : text_argument(L, 1, "io.write")) {
        if (c == '\n') print_line(L, std::exchange(state_of(L).unfinished_line, {}));
        else state_of(L).unfinished_line += c;
    }
    return 0;
}

int uniform(lua_State* L) {
    lua_pushnumber(L, fish_of(L).random.uniform());
    return 1;
}

int seed(lua_State* L) {
    fish_of(L).random.seed(static_cast<std::uint64_t>(integer_argument(L, 1, "math.randomseed")));
    return 0;
}

int environment(lua_State* L) {
    push_anchor(L, state_of(L).environment);
    return 1;
}

int restoring(lua_State* L) {
    lua_pushboolean(L, is_restoring(L));
    return 1;
}

int stopping(lua_State* L) {
    lua_pushboolean(L, state_of(L).stopping);
    return 1;
}

/// Place of the innermost Lua line of the deck.
Place calling_place(lua_State* L) {
    lua_Debug record;
    for (int level = 1; lua_getstack(L, level, &record); ++level) {
        lua_getinfo(L, "Sl", &record);
        if (const Source* source = state_of(L).sources.find(record.source))
            return line_place(*source, record.currentline);
    }
    return {};
}

/// Runs command lines. Leaves the reason why the last cycling command ended, or nil; when the output is caught, the output comes before it.
int run_lines(lua_State* L, const char* function, bool caught) {
    World& world = world_of(L);
    const std::string text = text_argument(L, 1, function);
    const Place place = calling_place(L);
    std::string printed, before = std::exchange(world.stopped_by, {});
    if (!is_restoring(L)) printed = world.command(text, place ? place.source->name : "", place.line, caught);
    if (caught) lua_pushlstring(L, printed.data(), printed.size());
    if (world.stopped_by.empty()) lua_pushnil(L);
    else lua_pushlstring(L, world.stopped_by.data(), world.stopped_by.size());
    if (world.stopped_by.empty()) world.stopped_by = std::move(before);
    return caught ? 2 : 1;
}

int command(lua_State* L) { return run_lines(L, "command", false); }
int capture(lua_State* L) { return run_lines(L, "capture", true); }

int require(lua_State* L) {
    push_module(L, text_argument(L, 1, "require"), calling_place(L));
    return 1;
}

/// A new global variable of the user; a function can be called by FISH from now on.
int new_global(lua_State* L) {
    const bool function = lua_type(L, 3) == LUA_TFUNCTION && lua_type(L, 2) == LUA_TSTRING;
    if (function) adopt_lua_function(L, lua_tostring(L, 2));
    lua_settop(L, 3);
    lua_rawset(L, 1);
    return 0;
}

/// (message, hint)
int fail(lua_State* L) { throw Diagnostic(text_argument(L, 1, "fail"), text_argument(L, 2, "fail"), Fault::run); }

constexpr std::array<luaL_Reg, 20> natives{{
    {"fail", guarded<fail>},
    {"vector", guarded<vector>},
    {"read_fish", guarded<read_fish>},
    {"write_fish", guarded<write_fish>},
    {"as_array", guarded<as_array>},
    {"is_array", guarded<is_array>},
    {"order", guarded<order>},
    {"print", guarded<print>},
    {"write", guarded<write>},
    {"uniform", guarded<uniform>},
    {"seed", guarded<seed>},
    {"environment", guarded<environment>},
    {"require_file", guarded<require_file>},
    {"open_file", guarded<open_file>},
    {"restoring", guarded<restoring>},
    {"stopping", guarded<stopping>},
    {"command", guarded<command>},
    {"capture", guarded<capture>},
    {"require", guarded<require>},
    {nullptr, nullptr},
}};

} // namespace

void open_library(lua_State* L) {
    // A script with access to the type of files could give it a finalizer.
    luaL_getmetatable(L, LUA_FILEHANDLE);
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
    load_text(L, std::string(built_in_module("library")), "=library");
    lua_newtable(L);
    luaL_setfuncs(L, natives.data(), 0);
    add_model_natives(L);
    add_sample_natives(L);
    add_hook_natives(L);
    lua_pushboolean(L, options_of(L).trusted);
    call_protected(L, 2, 1);

    lua_newtable(L); // the user's global variables
    lua_pushvalue(L, -1);
    lua_setfield(L, -3, "_G");
    lua_newtable(L);
    lua_pushvalue(L, -3);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, guarded<new_global>);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    state_of(L).environment = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_pop(L, 1);
}

} // namespace kaya::script
