#include "lang/script/libraries/lua_library.hpp"

#include "lang/script/base/modules.hpp"
#include "lang/script/base/source_list.hpp"
#include "lang/script/libraries/files.hpp"
#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/fish_library.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya::script {

namespace {

std::int32_t table_argument(lua_State* L, const char* function) {
    const std::string name = text_argument(L, 1, function);
    const World& world = world_of(L);
    const std::int32_t table = find_table(world, name);
    if (table >= 0) return table;
    std::vector<std::string_view> names;
    for (const auto& known : world.tables()) names.push_back(known.name);
    const auto meant = did_you_mean(name, names);
    throw Diagnostic(fmt::format("there is no kind of object '{}'", name),
                     meant.empty() ? fmt::format("kinds: {}", fmt::join(names, ", "))
                                   : fmt::format("did you mean '{}'?", meant),
                     Fault::run);
}

int tables(lua_State* L) {
    lua_newtable(L);
    lua_Integer i = 0;
    for (const auto& table : world_of(L).tables()) {
        lua_pushlstring(L, table.name.data(), table.name.size());
        lua_rawseti(L, -2, ++i);
    }
    return 1;
}

/// Upvalues: table, number of the next object.
int next_object(lua_State* L) {
    World& world = world_of(L);
    const auto table = static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(1)));
    const auto at = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(2)));
    if (at >= world.count(table)) {
        lua_pushnil(L);
        return 1;
    }
    lua_pushinteger(L, static_cast<lua_Integer>(at + 1));
    lua_replace(L, lua_upvalueindex(2));
    lua_pushlightuserdata(L, pack_handle(world.at(table, at)));
    return 1;
}

/// (table): the iterator over all its objects.
int list(lua_State* L) {
    lua_pushinteger(L, table_argument(L, "list"));
    lua_pushinteger(L, 0);
    lua_pushcclosure(L, guarded<next_object>, 2);
    return 1;
}

int count(lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(world_of(L).count(table_argument(L, "count"))));
    return 1;
}

/// (table, field, kind of reduction)
int reduce(lua_State* L) {
    const std::string caller = text_argument(L, 3, "sum");
    const std::int32_t table = table_argument(L, caller.c_str());
    const std::string name = text_argument(L, 2, caller.c_str());
    World& world = world_of(L);
    const auto& info = world.tables()[table];
    const auto field = find_field(info.fields, name);
    if (field < 0) fail_unknown_field(info.name, info.fields, name);
    lua_pushnumber(L, world.reduce(table, static_cast<std::size_t>(field), caller));
    return 1;
}

/// (table, vector) or (table, x, y, z)
int nearest(lua_State* L) {
    const std::int32_t table = table_argument(L, "nearest");
    Vec3 place;
    if (lua_gettop(L) == 2) place = vector_argument(L, 2, "nearest");
    else
        for (int i = 0; i < 3; ++i) place[i] = number_argument(L, i + 2, "nearest");
    World& world = world_of(L);
    const auto relation = find_relation(world, RelationInfo::Form::nearest, -1, table);
    if (relation < 0) throw Diagnostic("corners of faces cannot be searched", "search for the gridpoint", Fault::run);
    push_lua_value(L, world.relate(static_cast<std::size_t>(relation), {}, place));
    return 1;
}

Handle object_argument(lua_State* L, const char* function) {
    if (lua_type(L, 1) == LUA_TLIGHTUSERDATA) return unpack_handle(lua_touserdata(L, 1));
    throw Diagnostic(fmt::format("'{}' needs a contact, a sub-contact or a zone, here it is given {}", function,
                                 describe_value(L, 1)),
                     {}, Fault::run);
}

/// (object, name)
int property(lua_State* L) {
    const Handle object = object_argument(L, "property");
    push_lua_value(L, world_of(L).property(object, text_argument(L, 2, "property")));
    return 1;
}

/// (object, name, value)
int set_property(lua_State* L) {
    const Handle object = object_argument(L, "set_property");
    const std::string name = text_argument(L, 2, "set_property");
    const double value = number_argument(L, 3, "set_property");
    if (!is_restoring(L)) world_of(L).set_property(object, name, value);
    return 0;
}

void push_numbers(lua_State* L, std::span<const double> numbers) {
    lua_createtable(L, static_cast<int>(numbers.size()), 0);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        lua_pushnumber(L, numbers[i]);
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
}

/// Numbers under that name, and the least, greatest and last of them, in the table at the top of the stack.
void set_samples(lua_State* L, const char* name, std::span<const double> values) {
    push_numbers(L, values);
    lua_setfield(L, -2, name);
    if (values.empty()) return;
    const auto [least, greatest] = std::ranges::minmax(values);
    for (const auto& [key, value] :
         {std::pair{"minimum", least}, std::pair{"maximum", greatest}, std::pair{"last", values.back()}}) {
        lua_pushnumber(L, value);
        lua_setfield(L, -2, key);
    }
}

/// (label or number): its samples, their times, and the least, greatest and last of them
int history(lua_State* L) {
    const std::string name = lua_isinteger(L, 1) ? std::to_string(lua_tointeger(L, 1)) : text_argument(L, 1, "history");
    const auto samples = world_of(L).history(name);
    if (!samples)
        throw Diagnostic(fmt::format("there is no history '{}'", name), "name it by its number or its label: list hist",
                         Fault::run);
    lua_newtable(L);
    push_numbers(L, samples->times);
    lua_setfield(L, -2, "times");
    set_samples(L, "values", samples->values);
    return 1;
}

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

const Member& global_argument(lua_State* L) {
    const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : nullptr;
    const Member* member = key ? names_of(L).fields.globals.find(key) : nullptr;
    if (!member) fail_unknown_field("the model", world_of(L).globals(), key ? key : describe_value(L, 2));
    return *member;
}

int read_model(lua_State* L) {
    push_lua_value(L, world_of(L).get(World::whole_model, global_argument(L).number));
    return 1;
}

int write_model(lua_State* L) {
    const Member& member = global_argument(L);
    const auto& info = world_of(L).globals()[member.number];
    if (!info.writable)
        throw Diagnostic(fmt::format("'{}' of the model can be read, not set", info.name), {}, Fault::run);
    if (!is_restoring(L))
        world_of(L).set(World::whole_model, member.number, value_at(L, 3, fmt::format("the new '{}'", info.name)));
    return 0;
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

/// (number of a table): its x and y, and the least, greatest and last y
int read_table(lua_State* L) {
    const std::int64_t number = integer_argument(L, 1, "tables");
    const Tables& all = fish_of(L).tables;
    const auto found = all.find(number);
    if (found == all.end()) {
        lua_pushnil(L);
        return 1;
    }
    std::vector<double> x, y;
    for (const auto& point : found->second.points) {
        x.push_back(point.x);
        y.push_back(point.y);
    }
    lua_newtable(L);
    push_numbers(L, x);
    lua_setfield(L, -2, "x");
    set_samples(L, "y", y);
    return 1;
}

/// (number of a table, x values, y values)
int write_table(lua_State* L) {
    const std::int64_t number = integer_argument(L, 1, "tables");
    Table table;
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, 2)); ++i) {
        lua_rawgeti(L, 2, i);
        lua_rawgeti(L, 3, i);
        const bool numbers = lua_type(L, -1) == LUA_TNUMBER && lua_type(L, -2) == LUA_TNUMBER;
        if (!numbers || !std::isfinite(lua_tonumber(L, -1)) || !std::isfinite(lua_tonumber(L, -2)))
            throw Diagnostic(fmt::format("point {} of table {} is not two numbers", i, number),
                             "give x and y the same number of numbers", Fault::run);
        table.insert(lua_tonumber(L, -2), lua_tonumber(L, -1));
        lua_pop(L, 2);
    }
    if (lua_rawlen(L, 3) != lua_rawlen(L, 2))
        throw Diagnostic(fmt::format("table {} is given {} x and {} y", number, lua_rawlen(L, 2), lua_rawlen(L, 3)),
                         "give as many of both", Fault::run);
    if (is_restoring(L)) return 0;
    table.name = fish_of(L).tables[number].name;
    fish_of(L).tables[number] = std::move(table);
    return 0;
}

/// (number of a table, x): y on straight lines between its points
int table_value(lua_State* L) {
    const std::int64_t number = integer_argument(L, 1, "tables");
    const auto found = fish_of(L).tables.find(number);
    if (found == fish_of(L).tables.end()) throw Diagnostic(fmt::format("there is no table {}", number), {}, Fault::run);
    lua_pushnumber(L, found->second.at(number_argument(L, 2, "at")));
    return 1;
}

int add_hook(lua_State* L) {
    static constexpr std::array<std::string_view, 3> moments{"before_cycle", "after_forces", "after_cycle"};
    const std::string name = text_argument(L, 1, "hook");
    LuaHook made;
    for (std::size_t i = 0; i < moments.size(); ++i)
        if (moments[i] == name) made.moment = static_cast<Moment>(i);
    if (lua_type(L, 2) != LUA_TFUNCTION)
        throw Diagnostic(fmt::format("hook.{} needs a function, here it is given {}", name, describe_value(L, 2)), {},
                         Fault::run);
    if (!lua_isnoneornil(L, 3)) {
        made.interval = integer_argument(L, 3, "hook");
        if (made.interval < 1)
            throw Diagnostic(fmt::format("the interval of a hook is {}", made.interval), "it counts cycles from 1 up",
                             Fault::run);
    }
    lua_pushvalue(L, 2);
    made.function = luaL_ref(L, LUA_REGISTRYINDEX);
    hooks_of(L).of_lua.push_back(made);
    hooks_of(L).registered = true;
    lua_pushvalue(L, 2);
    return 1;
}

/// Removes every hook of this function.
int remove_hook(lua_State* L) {
    std::erase_if(hooks_of(L).of_lua, [&](const LuaHook& hook) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, hook.function);
        const bool same = lua_rawequal(L, -1, 1);
        lua_pop(L, 1);
        if (same) luaL_unref(L, LUA_REGISTRYINDEX, hook.function);
        return same;
    });
    return 0;
}

int name_history(lua_State* L) {
    hooks_of(L).registered = true;
    lua_pushstring(L, fmt::format("lua_history_{}", ++hooks_of(L).lua_histories).c_str());
    return 1;
}

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

constexpr std::array<luaL_Reg, 36> natives{{
    {"fail", guarded<fail>},
    {"tables", guarded<tables>},
    {"list", guarded<list>},
    {"count", guarded<count>},
    {"reduce", guarded<reduce>},
    {"nearest", guarded<nearest>},
    {"property", guarded<property>},
    {"set_property", guarded<set_property>},
    {"history", guarded<history>},
    {"vector", guarded<vector>},
    {"read_model", guarded<read_model>},
    {"write_model", guarded<write_model>},
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
    {"read_table", guarded<read_table>},
    {"write_table", guarded<write_table>},
    {"table_value", guarded<table_value>},
    {"add_hook", guarded<add_hook>},
    {"remove_hook", guarded<remove_hook>},
    {"name_history", guarded<name_history>},
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
