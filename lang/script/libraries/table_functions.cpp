// Built-in functions of FISH on tables, which have numbers and may have names: table(n, x), xtable(n, i), ytable(n, i), vtable(n, i),
// table_size(n).
#include "base/lower_case.hpp"
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

/// The first argument: the number of a table, or its name.
std::int64_t table_argument(lua_State* L, const char* function, bool make = false) {
    if (lua_type(L, 1) != LUA_TSTRING) return integer_argument(L, 1, function);
    const std::string name = text_argument(L, 1, function);
    Tables& tables = fish_of(L).tables;
    const auto found =
        std::ranges::find_if(tables, [&](const auto& entry) { return equal_ignoring_case(entry.second.name, name); });
    if (found != tables.end() && !name.empty()) return found->first;
    if (!make || name.empty())
        throw Diagnostic(fmt::format("there is no table '{}'", name), "make it before: table.create('name')",
                         Fault::run);
    const std::int64_t next = tables.empty() ? 1 : std::max<std::int64_t>(tables.rbegin()->first, 0) + 1;
    tables[next].name = name;
    return next;
}

Table& existing_table(lua_State* L, const char* function) {
    const std::int64_t number = table_argument(L, function);
    Tables& tables = fish_of(L).tables;
    const auto found = tables.find(number);
    if (found == tables.end() || found->second.points().empty())
        throw Diagnostic(fmt::format("table {} holds no point", number), "fill it before it is read", Fault::run);
    return found->second;
}

/// The second argument: the i-th of so many points, counted from 0.
std::size_t point_number(lua_State* L, const char* function, std::size_t count) {
    const std::int64_t i = integer_argument(L, 2, function);
    if (i < 1 || i > static_cast<std::int64_t>(count))
        throw Diagnostic(fmt::format("table {} has points 1 to {}, not {}", text_at(L, 1), count, i), {}, Fault::run);
    return static_cast<std::size_t>(i - 1);
}

const TablePoint& existing_point(lua_State* L, const char* function) {
    const auto& points = existing_table(L, function).points();
    return points[point_number(L, function, points.size())];
}

/// Changes the i-th point; one after the last makes a new one.
template <class Change> int change_point(lua_State* L, const char* function, Change change) {
    const std::int64_t number = table_argument(L, function, true);
    Table& table = fish_of(L).tables[number];
    const auto& points = table.points();
    const bool is_new = integer_argument(L, 2, function) == static_cast<std::int64_t>(points.size()) + 1;
    if (!is_new) existing_table(L, function);
    const std::size_t i = is_new ? points.size() : point_number(L, function, points.size());
    TablePoint point = is_new ? TablePoint{} : points[i];
    change(point);
    table.put(i, point);
    return 0;
}

int read_table(lua_State* L) {
    const Table& table = existing_table(L, "table");
    table.require_sorted(fmt::format("table {}", text_at(L, 1)));
    lua_pushnumber(L, table.at(number_argument(L, 2, "table")));
    return 1;
}

int write_table(lua_State* L) {
    const std::int64_t number = table_argument(L, "table", true);
    const double x = number_argument(L, 2, "table"), y = number_argument(L, 3, "table");
    Table& table = fish_of(L).tables[number];
    table.require_sorted(fmt::format("table {}", text_at(L, 1)));
    table.set(x, y);
    return 0;
}

int read_x(lua_State* L) {
    lua_pushnumber(L, existing_point(L, "xtable").x);
    return 1;
}

int write_x(lua_State* L) {
    const double x = number_argument(L, 3, "xtable");
    return change_point(L, "xtable", [x](TablePoint& point) { point.x = x; });
}

int read_y(lua_State* L) {
    lua_pushnumber(L, existing_point(L, "ytable").y);
    return 1;
}

int write_y(lua_State* L) {
    const double y = number_argument(L, 3, "ytable");
    return change_point(L, "ytable", [y](TablePoint& point) { point.y = y; });
}

int read_vector(lua_State* L) {
    const TablePoint& point = existing_point(L, "vtable");
    push_vector(L, {point.x, point.y, 0});
    return 1;
}

int write_vector(lua_State* L) {
    const Vec3 v = vector_argument(L, 3, "vtable");
    return change_point(L, "vtable", [v](TablePoint& point) { point = {v[0], v[1]}; });
}

int size(lua_State* L) {
    const Tables& tables = fish_of(L).tables;
    const auto found = tables.find(table_argument(L, "table_size"));
    lua_pushinteger(L, found == tables.end() ? 0 : static_cast<lua_Integer>(found->second.points().size()));
    return 1;
}

/// table_id(n): the number again when the table has points, else 0.
int identify(lua_State* L) {
    const Tables& tables = fish_of(L).tables;
    const std::int64_t number = table_argument(L, "table_id");
    lua_pushinteger(L, tables.contains(number) ? number : 0);
    return 1;
}

int read_name(lua_State* L) {
    const Tables& tables = fish_of(L).tables;
    const auto found = tables.find(table_argument(L, "table_name"));
    const std::string name = found == tables.end() ? std::string() : found->second.name;
    lua_pushlstring(L, name.data(), name.size());
    return 1;
}

int write_name(lua_State* L) {
    const std::int64_t number = table_argument(L, "table_name");
    fish_of(L).tables[number].name = text_argument(L, 2, "table_name");
    return 0;
}

/// get_table(n): the number; creates the table if it does not exist. get_table(name): the number of the table of this name, 0 if there is
/// none.
int find(lua_State* L) {
    Tables& tables = fish_of(L).tables;
    if (lua_type(L, 1) != LUA_TSTRING) {
        const std::int64_t number = integer_argument(L, 1, "get_table");
        tables[number];
        lua_pushinteger(L, number);
        return 1;
    }
    const std::string name = text_argument(L, 1, "get_table");
    const auto found = std::ranges::find_if(tables, [&name](const auto& entry) { return entry.second.name == name; });
    lua_pushinteger(L, name.empty() || found == tables.end() ? 0 : found->first);
    return 1;
}

/// table.create(n) and table.create(name)
int create(lua_State* L) {
    const std::int64_t number = table_argument(L, "table.create", true);
    fish_of(L).tables[number];
    lua_pushinteger(L, number);
    return 1;
}

int remove(lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(fish_of(L).tables.erase(table_argument(L, "del_table"))));
    return 1;
}

constexpr std::array table_functions{
    BuiltInFunction{"table", 2, 2, guarded<read_table>, guarded<write_table>},
    BuiltInFunction{"xtable", 2, 2, guarded<read_x>, guarded<write_x>},
    BuiltInFunction{"ytable", 2, 2, guarded<read_y>, guarded<write_y>},
    BuiltInFunction{"vtable", 2, 2, guarded<read_vector>, guarded<write_vector>},
    BuiltInFunction{"table_size", 1, 1, guarded<size>},
    BuiltInFunction{"table_id", 1, 1, guarded<identify>},
    BuiltInFunction{"table_name", 1, 1, guarded<read_name>, guarded<write_name>},
    BuiltInFunction{"get_table", 1, 1, guarded<find>},
    BuiltInFunction{"del_table", 1, 1, guarded<remove>},
    BuiltInFunction{"table.create", 1, 1, guarded<create>},
};

} // namespace

void add_tables(lua_State* L) { add_built_ins(L, table_functions); }

} // namespace kaya::script
