#include "lang/script/names/handle_type.hpp"

#include "lang/script/names/names.hpp"
#include "lang/script/state/arithmetic.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"
#include "lang/script/values/value_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::script {

namespace {

std::string with_article(std::string_view name) {
    const bool vowel = !name.empty() && std::string_view("aeiou").find(name.front()) != std::string_view::npos;
    return fmt::format("{} {}", vowel ? "an" : "a", name);
}

/// The member that the key at stack index 2 names.
const Member& member_at(lua_State* L, const Handle& handle) {
    const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : nullptr;
    const Member* member = key ? names_of(L).fields.tables[handle.table].find(key) : nullptr;
    if (member) return *member;
    const auto& table = world_of(L).tables()[handle.table];
    fail_unknown_field(with_article(table.name), table.fields, key ? key : describe_value(L, 2));
}

int index(lua_State* L) {
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const Member& member = member_at(L, handle);
    if (member.kind == MemberKind::field) {
        push_lua_value(L, world_of(L).get(handle, member.number));
    } else if (member.kind == MemberKind::alive) {
        lua_pushboolean(L, world_of(L).alive(handle));
    } else {
        push_anchor(L, names_of(L).methods);
        lua_rawgeti(L, -1, member.number + 1);
    }
    return 1;
}

int new_index(lua_State* L) {
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const Member& member = member_at(L, handle);
    const auto& table = world_of(L).tables()[handle.table];
    if (member.kind != MemberKind::field || !table.fields[member.number].writable)
        throw Diagnostic(fmt::format("'{}' of {} can be read, not set", lua_tostring(L, 2), with_article(table.name)),
                         {}, Fault::run);
    if (is_restoring(L)) return 0;
    world_of(L).set(handle, member.number, value_at(L, 3, fmt::format("the new '{}'", lua_tostring(L, 2))));
    return 0;
}

int show(lua_State* L) {
    const std::string text = handle_text(world_of(L), unpack_handle(lua_touserdata(L, 1)));
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

/// c:sub_contacts(): the function that the generic `for` calls, the parent, and no first value.
int next_child(lua_State* L) {
    const auto child = static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(1)));
    const bool first = lua_isnil(L, 2);
    const Handle handle = unpack_handle(lua_touserdata(L, first ? 1 : 2));
    World& world = world_of(L);
    if (!first)
        push_lua_value(L, world.relate(names_of(L).next_relations[static_cast<std::size_t>(handle.table)], handle));
    else push_lua_value(L, world.relate(list_of_parts(world, handle.table, child), handle));
    return 1;
}

int children(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA)
        throw Diagnostic("this list belongs to an object", "write object:list(), with a colon", Fault::run);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushcclosure(L, guarded<next_child>, 1);
    lua_pushvalue(L, 1);
    lua_pushnil(L);
    return 3;
}

/// Lua's copy of the name, kept alive permanently.
const char* kept_name(lua_State* L, std::string_view name) {
    lua_pushlstring(L, name.data(), name.size());
    const char* address = lua_tostring(L, -1);
    push_anchor(L, names_of(L).kept);
    lua_insert(L, -2);
    luaL_ref(L, -2);
    lua_pop(L, 1);
    return address;
}

void index_fields(lua_State* L) {
    lua_newtable(L);
    names_of(L).kept = luaL_ref(L, LUA_REGISTRYINDEX);
    const auto& tables = world_of(L).tables();
    for (const auto& table : tables) {
        MemberMap members;
        members.add({kept_name(L, "alive"), MemberKind::alive, 0});
        for (std::size_t child = 0; child < tables.size(); ++child)
            members.add({kept_name(L, fmt::format("{}s", tables[child].name)), MemberKind::method,
                         static_cast<std::uint32_t>(child)});
        for (std::size_t i = 0; i < table.fields.size(); ++i)
            members.add({kept_name(L, table.fields[i].name), MemberKind::field, static_cast<std::uint32_t>(i)});
        names_of(L).fields.tables.push_back(std::move(members));
    }
    for (std::int32_t table = 0; table < static_cast<std::int32_t>(tables.size()); ++table)
        names_of(L).next_relations.push_back(static_cast<std::size_t>(
            std::max<std::ptrdiff_t>(0, find_relation(world_of(L), RelationInfo::Form::next, table, table))));
    const auto& globals = world_of(L).globals();
    for (std::size_t i = 0; i < globals.size(); ++i)
        names_of(L).fields.globals.add(
            {kept_name(L, globals[i].name), MemberKind::field, static_cast<std::uint32_t>(i)});
}

} // namespace

void open_handles(lua_State* L) {
    index_fields(L);
    lua_newtable(L);
    for (std::size_t child = 0; child < world_of(L).tables().size(); ++child) {
        lua_pushinteger(L, static_cast<lua_Integer>(child));
        lua_pushcclosure(L, guarded<children>, 1);
        lua_rawseti(L, -2, static_cast<lua_Integer>(child) + 1);
    }
    names_of(L).methods = luaL_ref(L, LUA_REGISTRYINDEX);

    lua_pushlightuserdata(L, L); // all light userdata share one metatable
    lua_newtable(L);
    lua_pushcfunction(L, guarded<index>);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, guarded<new_index>);
    lua_setfield(L, -2, "__newindex");
    lua_pushcfunction(L, guarded<show>);
    lua_setfield(L, -2, "__tostring");
    lua_pushstring(L, "pointer");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    add_refusing_arithmetic(L);
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
}

} // namespace kaya::script
