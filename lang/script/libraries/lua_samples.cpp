// Samples of histories and tables of numbers, for Lua.
#include "lang/script/libraries/lua_natives.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace kaya::script {

namespace {

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
    for (const auto& point : found->second.points()) {
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
    found->second.require_sorted(fmt::format("table {}", number));
    lua_pushnumber(L, found->second.at(number_argument(L, 2, "at")));
    return 1;
}

constexpr luaL_Reg natives[] = {
    {"history", guarded<history>},
    {"read_table", guarded<read_table>},
    {"write_table", guarded<write_table>},
    {"table_value", guarded<table_value>},
    {nullptr, nullptr},
};

} // namespace

void add_sample_natives(lua_State* L) { luaL_setfuncs(L, natives, 0); }

} // namespace kaya::script
