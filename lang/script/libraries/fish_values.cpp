#include "lang/script/libraries/fish_values.hpp"

#include "lang/fish/nearest.hpp"
#include "lang/script/base/modules.hpp"
#include "lang/script/libraries/matrices.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <new>

namespace kaya::script {

namespace {

void push_text(lua_State* L, std::string_view text) { lua_pushlstring(L, text.data(), text.size()); }

/// (message, hint)
int stop(lua_State* L) { throw Diagnostic(text_argument(L, 1, "stop"), text_argument(L, 2, "stop"), Fault::run); }

int describe(lua_State* L) {
    push_text(L, describe_value(L, 1));
    return 1;
}

int text(lua_State* L) {
    push_text(L, text_at(L, 1));
    return 1;
}

/// All arguments, with commas between.
int texts(lua_State* L) {
    std::string all;
    for (int i = 1; i <= lua_gettop(L); ++i) all += (i > 1 ? "," : "") + text_at(L, i);
    push_text(L, all);
    return 1;
}

int vector_test(lua_State* L) {
    lua_pushboolean(L, is_vector(L, 1));
    return 1;
}

int pointer_test(lua_State* L) {
    lua_pushboolean(L, lua_type(L, 1) == LUA_TLIGHTUSERDATA);
    return 1;
}

/// A number that sorts pointers in the order of their tables and rows.
int order(lua_State* L) {
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    lua_pushinteger(L, static_cast<lua_Integer>(handle.table) << slot_bits | handle.slot);
    return 1;
}

/// "block.gp" for a pointer to a gridpoint.
int family(lua_State* L) {
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const auto& tables = world_of(L).tables();
    const auto table = static_cast<std::size_t>(handle.table);
    push_text(L, handle.table >= 0 && table < tables.size() ? tables[table].modern : std::string_view{});
    return 1;
}

int near(lua_State* L) {
    const std::string called = text_argument(L, 1, "near");
    std::vector<std::string_view> names;
    for (const auto& [name, built_in] : names_of(L).built_ins) names.push_back(name);
    const auto meant = fish::nearest_name(called, names);
    push_text(L, meant.empty() ? std::string() : fmt::format("did you mean '{}'?", meant));
    return 1;
}

int number(lua_State* L) {
    if (lua_type(L, 1) != LUA_TNUMBER)
        throw Diagnostic(fmt::format("a number is needed here, and this is {}", describe_value(L, 1)), {}, Fault::run);
    lua_settop(L, 1);
    return 1;
}

int vector(lua_State* L) {
    Vec3 made;
    for (int i = 0; i < 3; ++i) made[i] = number_argument(L, i + 1, "->");
    push_vector(L, made);
    return 1;
}

int fish_value(lua_State* L) {
    lua_settop(L, 1);
    make_fish_value(L);
    return 1;
}

/// A quantity of the model by its name in Lua; nil when there is none.
int model_value(lua_State* L) {
    World& world = world_of(L);
    const auto field = find_field(world.globals(), text_argument(L, 1, "model"));
    if (field < 0) lua_pushnil(L);
    else push_fish_value(L, world.get(World::whole_model, static_cast<std::size_t>(field)));
    return 1;
}

/// Runs a program; only without the lock.
int run_program(lua_State* L) {
    const std::string command = text_argument(L, 1, "system.command");
    if (!options_of(L).trusted)
        throw Diagnostic("'system.command' starts another program, which a deck may not do",
                         "start the program outside of the run", Fault::run);
    lua_pushinteger(L, is_restoring(L) ? 0 : std::system(command.c_str()));
    return 1;
}

constexpr std::array<luaL_Reg, 15> natives{{{"stop", guarded<stop>},
                                            {"describe", guarded<describe>},
                                            {"text", guarded<text>},
                                            {"texts", guarded<texts>},
                                            {"is_vector", guarded<vector_test>},
                                            {"is_pointer", guarded<pointer_test>},
                                            {"order", guarded<order>},
                                            {"family", guarded<family>},
                                            {"near", guarded<near>},
                                            {"number", guarded<number>},
                                            {"vector", guarded<vector>},
                                            {"fish_value", guarded<fish_value>},
                                            {"model_value", guarded<model_value>},
                                            {"run_program", guarded<run_program>},
                                            {nullptr, nullptr}}};

/// Pushes the functions of the program that the modules call. `whole` of the runtime, at the top of the stack, is one of them.
void push_natives(lua_State* L) {
    lua_newtable(L);
    luaL_setfuncs(L, natives.data(), 0);
    add_matrix_functions(L);
    lua_getfield(L, -2, "whole");
    lua_setfield(L, -2, "whole");
    push_anchor(L, names_of(L).readers);
    lua_setfield(L, -2, "readers");
    push_anchor(L, names_of(L).writers);
    lua_setfield(L, -2, "writers");
    push_anchor(L, fish_of(L).globals);
    lua_setfield(L, -2, "globals");
}

} // namespace

void open_values(lua_State* L) {
    load_text(L, std::string(built_in_module("fish_values")), "=fish_values");
    lua_pushvalue(L, -2);
    lua_pushvalue(L, -3); // push_natives finds the runtime at the top
    push_natives(L);
    lua_remove(L, -2);
    call_protected(L, 2, 0);
}

namespace {
/// The module returns rows {name, least, most, read, write}.
void add_functions_of(lua_State* L, const std::string& module) {
    load_text(L, std::string(built_in_module(module)), ("=" + module).c_str());
    push_anchor(L, state_of(L).runtime);
    push_natives(L);
    call_protected(L, 2, 1);
    const int rows = lua_gettop(L), row = rows + 1;
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, rows)); ++i) {
        lua_rawgeti(L, rows, i);
        const auto whole_at = [&](int place) {
            lua_rawgeti(L, row, place);
            const auto number = static_cast<int>(lua_tointeger(L, -1));
            lua_pop(L, 1);
            return number;
        };
        lua_rawgeti(L, row, 1);
        const std::string name = lua_tostring(L, -1);
        lua_pop(L, 1);
        const bool hidden = fish::makes_value(name); // a name of variables in the classic dialect
        lua_rawgeti(L, row, 4);
        add_reader(L, name, whole_at(2), whole_at(3));
        if (lua_rawgeti(L, row, 5) == LUA_TFUNCTION) add_writer(L, name);
        if (hidden) names_of(L).built_ins.erase(name);
        lua_settop(L, rows);
    }
    lua_settop(L, rows - 1);
}

} // namespace

void add_value_functions(lua_State* L) {
    for (const char* const module : {"fish_functions", "fish_tensors", "fish_matrices", "fish_splitting"})
        add_functions_of(L, module);
}

} // namespace kaya::script
