// Names of newer versions of FISH that mean the same as a classic one: math.sqrt, block.contact.pos.
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <fmt/format.h>
#include <iterator>

namespace kaya::script {

namespace {

struct Alias {
    std::string_view modern, classic;
};

// clang-format off
constexpr Alias aliases[] = {
    {"math.abs", "abs"}, {"math.acos", "acos"}, {"math.asin", "asin"}, {"math.atan", "atan"}, {"math.atan2", "atan2"},
    {"math.cos", "cos"}, {"math.sin", "sin"}, {"math.tan", "tan"}, {"math.exp", "exp"}, {"math.ln", "ln"}, {"math.log", "log"},
    {"math.sqrt", "sqrt"}, {"math.sgn", "sgn"}, {"math.round", "round"}, {"math.max", "max"}, {"math.min", "min"},
    {"math.pi", "pi"}, {"math.degrad", "degrad"}, {"math.mag", "mag"}, {"math.mag2", "mag2"}, {"math.dot", "dot"},
    {"math.cross", "cross"}, {"math.unit", "unit"}, {"math.random.uniform", "urand"}, {"math.random.gauss", "grand"},
    {"math.and", "and"}, {"math.or", "or"}, {"math.not", "not"}, {"math.lshift", "lshift"}, {"math.rshift", "rshift"},
    {"math.dip.from.normal", "dipfromnorm"}, {"math.ddir.from.normal", "ddfromnorm"}, {"math.normal.from.dip.ddir", "normfromdipdd"},
    {"block.zone.stress.max", "z_sig3"}, {"block.zone.stress.min", "z_sig1"}, {"comp.x", "xcomp"}, {"comp.y", "ycomp"}, {"comp.z", "zcomp"},
    {"io.out", "out"},
    {"string.build", "buildstr"}, {"string.char", "char"}, {"string.len", "strlen"}, {"string.sub", "substr"},
    {"string.tolower", "tolower"}, {"string.toupper", "toupper"}, {"string.lower", "tolower"}, {"string.upper", "toupper"},
    {"string.token", "parse"},
    {"array.create", "get_array"}, {"array.delete", "lose_array"}, {"array.dim", "array_dim"}, {"array.size", "array_size"},
    {"file.open", "open"}, {"file.close", "close"}, {"file.read", "read"}, {"file.write", "write"},
    {"table.x", "xtable"}, {"table.y", "ytable"}, {"table.value", "vtable"}, {"table.size", "table_size"}, {"table.get", "get_table"},
    {"table.find", "get_table"},  {"table.id", "table_id"}, {"table.label", "table_name"},
    {"table.name", "table_name"}, {"table.delete", "del_table"},
    {"system.error", "error"}, {"system.clock", "clock"}, {"time.clock", "clock"}, {"code.name", "code_name"},
    {"global.step", "step"}, {"global.cycle", "cycle"}, {"global.fos", "fos"}, {"global.timestep", "tdel"},
    {"mech.time.total", "time"}, {"dynamic.time.total", "time"}, {"dynamic.step", "step"},
    {"dynamic.cycle", "cycle"}, {"dynamic.timestep", "tdel"},
};
// clang-format on

const RelationInfo& list_of(lua_State* L) {
    return world_of(L).relations()[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
}

/// Makes a list of the table at the top of the stack.
int as_list(lua_State* L) {
    push_runtime(L, "make_list");
    lua_insert(L, -2);
    lua_call(L, 1, 1);
    return 1;
}

int list_all(lua_State* L) {
    World& world = world_of(L);
    const std::int32_t table = list_of(L).to;
    const std::size_t count = world.count(table);
    lua_createtable(L, static_cast<int>(count), 1);
    for (std::size_t i = 0; i < count; ++i) {
        lua_pushlightuserdata(L, pack_handle(world.at(table, i)));
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    return as_list(L);
}

int list_children(lua_State* L) {
    World& world = world_of(L);
    const RelationInfo& list = list_of(L);
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const Handle owner = pointer ? unpack_handle(lua_touserdata(L, 1)) : Handle{};
    if (!pointer || owner.table != list.from)
        fail_argument(
            L, 1, list.array.data(),
            fmt::format("a pointer to a {}", world.tables()[static_cast<std::size_t>(list.from)].name).c_str());
    const auto first = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)));
    const std::size_t next = names_of(L).next_relations[static_cast<std::size_t>(list.to)];
    lua_newtable(L);
    lua_Integer count = 0;
    for (Handle child = world.relate(first, owner); child.generation != 0; child = world.relate(next, child)) {
        lua_pushlightuserdata(L, pack_handle(child));
        lua_rawseti(L, -2, ++count);
    }
    return as_list(L);
}

void add_alias(lua_State* L, const std::string& modern, const std::string& classic) {
    const auto found = names_of(L).built_ins.find(classic);
    // The world has no such field; or it is there already, as that field.
    if (found == names_of(L).built_ins.end() || names_of(L).built_ins.contains(modern)) return;
    const BuiltIn built_in = found->second;
    const auto push = [&](int anchor) {
        push_anchor(L, anchor);
        lua_pushlstring(L, classic.data(), classic.size());
        lua_rawget(L, -2);
        lua_remove(L, -2);
    };
    push(names_of(L).readers);
    add_reader(L, modern, built_in.least, built_in.most);
    if (!built_in.writable) return;
    push(names_of(L).writers);
    add_writer(L, modern);
}

} // namespace

std::vector<std::pair<std::string, std::string>> modern_names(const World& world) {
    std::vector<std::pair<std::string, std::string>> names;
    const auto add = [&](std::string_view modern, std::string_view classic) {
        if (!modern.empty()) names.emplace_back(modern, classic);
    };
    const auto add_field = [&](const FieldInfo& field) {
        add(field.modern, field.classic.empty() ? field.name : field.classic);
    };
    for (const auto& field : world.globals()) add_field(field);
    for (const auto& table : world.tables()) {
        for (const auto& field : table.fields) add_field(field);
        if (table.modern.empty()) continue;
        for (const char* what : {"near", "extra", "prop"})
            if (table.has_properties || what != std::string_view("prop"))
                names.emplace_back(fmt::format("{}.{}", table.modern, what), fmt::format("{}_{}", table.classic, what));
    }
    for (const auto& relation : world.relations())
        if (relation.form != RelationInfo::Form::nearest) add(relation.modern, relation.classic);
    for (const auto& alias : aliases) add(alias.modern, alias.classic);
    return names;
}

void add_modern_names(lua_State* L) {
    for (const auto& [modern, classic] : modern_names(world_of(L))) add_alias(L, modern, classic);
    const auto& relations = world_of(L).relations();
    for (std::size_t i = 0; i < relations.size(); ++i) {
        if (relations[i].array.empty()) continue;
        const bool all = relations[i].from < 0;
        lua_pushinteger(L, static_cast<lua_Integer>(i));
        lua_pushcclosure(L, all ? guarded<list_all> : guarded<list_children>, 1);
        add_reader(L, relations[i].array, all ? 0 : 1, all ? 0 : 1);
    }
    add_finders(L);
}

} // namespace kaya::script
