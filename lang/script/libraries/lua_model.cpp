// Objects, fields and properties of the model, for Lua.
#include "lang/script/libraries/lua_natives.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

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

constexpr luaL_Reg natives[] = {
    {"tables", guarded<tables>},
    {"list", guarded<list>},
    {"count", guarded<count>},
    {"reduce", guarded<reduce>},
    {"nearest", guarded<nearest>},
    {"property", guarded<property>},
    {"set_property", guarded<set_property>},
    {"read_model", guarded<read_model>},
    {"write_model", guarded<write_model>},
    {nullptr, nullptr},
};

} // namespace

void add_model_natives(lua_State* L) { luaL_setfuncs(L, natives, 0); }

} // namespace kaya::script
