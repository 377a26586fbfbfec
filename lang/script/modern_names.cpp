// Names of newer versions of FISH that mean the same as a classic one: math.sqrt, block.contact.pos.
#include "lang/script/built_ins.hpp"
#include "lang/script/field_index.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handles.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/values.hpp"

#include <fmt/format.h>
#include <iterator>

namespace kaya::script {

namespace {

struct Alias {
    std::string_view modern, classic;
};

constexpr Alias aliases[] = {
    {"math.abs", "abs"},
    {"math.acos", "acos"},
    {"math.asin", "asin"},
    {"math.atan", "atan"},
    {"math.atan2", "atan2"},
    {"math.cos", "cos"},
    {"math.sin", "sin"},
    {"math.tan", "tan"},
    {"math.exp", "exp"},
    {"math.ln", "ln"},
    {"math.log", "log"},
    {"math.sqrt", "sqrt"},
    {"math.sgn", "sgn"},
    {"math.round", "round"},
    {"math.max", "max"},
    {"math.min", "min"},
    {"math.pi", "pi"},
    {"math.degrad", "degrad"},
    {"math.mag", "mag"},
    {"math.mag2", "mag2"},
    {"math.dot", "dot"},
    {"math.cross", "cross"},
    {"math.unit", "unit"},
    {"math.random.uniform", "urand"},
    {"math.random.gauss", "grand"},
    {"math.dip.from.normal", "dipfromnorm"},
    {"math.ddir.from.normal", "ddfromnorm"},
    {"math.normal.from.dip.ddir", "normfromdipdd"},
    {"io.out", "out"},
    {"string.build", "buildstr"},
    {"string.char", "char"},
    {"string.len", "strlen"},
    {"string.sub", "substr"},
    {"string.tolower", "tolower"},
    {"string.toupper", "toupper"},
    {"string.token", "parse"},
    {"array.create", "get_array"},
    {"array.delete", "lose_array"},
    {"array.dim", "array_dim"},
    {"array.size", "array_size"},
    {"file.open", "open"},
    {"file.close", "close"},
    {"file.read", "read"},
    {"file.write", "write"},
    {"table.x", "xtable"},
    {"table.y", "ytable"},
    {"table.value", "vtable"},
    {"table.size", "table_size"},
    {"system.error", "error"},
    {"system.clock", "clock"},
    {"global.step", "step"},
};

const RelationInfo& list_of(lua_State* L) {
    return machine_of(L).world.relations()[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
}

/// Makes an array of one dimension of the table at the top of the stack.
int as_array(lua_State* L, lua_Integer size) {
    lua_createtable(L, 1, 0);
    lua_pushinteger(L, size);
    lua_rawseti(L, -2, 1);
    lua_setfield(L, -2, "dimensions");
    push_runtime(L, "as_array");
    lua_pushvalue(L, -2);
    lua_call(L, 1, 1);
    return 1;
}

int list_all(lua_State* L) {
    World& world = machine_of(L).world;
    const std::int32_t table = list_of(L).to;
    const std::size_t count = world.count(table);
    lua_createtable(L, static_cast<int>(count), 1);
    for (std::size_t i = 0; i < count; ++i) {
        lua_pushlightuserdata(L, pack_handle(world.at(table, i)));
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    return as_array(L, static_cast<lua_Integer>(count));
}

int list_children(lua_State* L) {
    World& world = machine_of(L).world;
    const RelationInfo& list = list_of(L);
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const Handle owner = pointer ? unpack_handle(lua_touserdata(L, 1)) : Handle{};
    if (!pointer || owner.table != list.from)
        fail_argument(
            L, 1, list.array.data(),
            fmt::format("a pointer to a {}", world.tables()[static_cast<std::size_t>(list.from)].name).c_str());
    const auto first = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)));
    const std::size_t next = machine_of(L).next_relations[static_cast<std::size_t>(list.to)];
    lua_newtable(L);
    lua_Integer count = 0;
    for (Handle child = world.relate(first, owner); child.generation != 0; child = world.relate(next, child)) {
        lua_pushlightuserdata(L, pack_handle(child));
        lua_rawseti(L, -2, ++count);
    }
    return as_array(L, count);
}

void add_alias(Machine& machine, const std::string& modern, const std::string& classic) {
    const auto found = machine.fish.built_ins.find(classic);
    if (found == machine.fish.built_ins.end()) return; // the world has no such field
    const BuiltIn built_in = found->second;
    lua_State* L = machine.lua;
    const auto push = [&](int anchor) {
        push_anchor(L, anchor);
        lua_pushlstring(L, classic.data(), classic.size());
        lua_rawget(L, -2);
        lua_remove(L, -2);
    };
    push(machine.anchors.readers);
    add_reader(machine, modern, built_in.least, built_in.most);
    if (!built_in.writable) return;
    push(machine.anchors.writers);
    add_writer(machine, modern);
}

} // namespace

std::vector<std::pair<std::string, std::string>> modern_names(const World& world) {
    std::vector<std::pair<std::string, std::string>> names;
    const auto add = [&](std::string_view modern, std::string_view classic) {
        if (!modern.empty()) names.emplace_back(modern, classic);
    };
    for (const auto& field : world.globals()) add(field.modern, field.classic);
    for (const auto& table : world.tables()) {
        for (const auto& field : table.fields) add(field.modern, field.classic);
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

void add_modern_names(Machine& machine) {
    for (const auto& [modern, classic] : modern_names(machine.world)) add_alias(machine, modern, classic);
    const auto& relations = machine.world.relations();
    for (std::size_t i = 0; i < relations.size(); ++i) {
        if (relations[i].array.empty()) continue;
        const bool all = relations[i].from < 0;
        lua_pushinteger(machine.lua, static_cast<lua_Integer>(i));
        lua_pushcclosure(machine.lua, all ? guarded<list_all> : guarded<list_children>, 1);
        add_reader(machine, relations[i].array, all ? 0 : 1, all ? 0 : 1);
    }
}

} // namespace kaya::script
