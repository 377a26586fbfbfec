// How FISH walks over lists of the model, by the relations of the world; and b_extra, c_extra, ...
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

const Traversal& traversal_of(lua_State* L) {
    return names_of(L).traversals[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
}
std::string_view table_name(lua_State* L) {
    return world_of(L).tables()[static_cast<std::size_t>(traversal_of(L).table)].name;
}

/// The upvalue of all: number of the traversal.
Handle pointer_argument(lua_State* L) {
    if (lua_type(L, 1) == LUA_TLIGHTUSERDATA) {
        const Handle handle = unpack_handle(lua_touserdata(L, 1));
        if (handle.table == traversal_of(L).table) return handle;
    }
    const Traversal& traversal = traversal_of(L);
    if (lua_type(L, 1) == LUA_TNUMBER && lua_tonumber(L, 1) == 0)
        throw Diagnostic(fmt::format("'{}' is given a null pointer", traversal.name),
                         "test the pointer against 0 before it is used", Fault::run);
    throw Diagnostic(fmt::format("'{}' needs a pointer to a {}, here it is given {}", traversal.name, table_name(L),
                                 describe_value(L, 1)),
                     {}, Fault::run);
}

void push_handle(lua_State* L, const Handle& handle) {
    if (handle.generation == 0) lua_pushinteger(L, 0);
    else lua_pushlightuserdata(L, pack_handle(handle));
}

void push_related(lua_State* L, const Handle& from, const World::At& at = {}) {
    push_handle(L, world_of(L).relate(traversal_of(L).relation, from, at));
}

int first_of_model(lua_State* L) {
    push_related(L, {});
    return 1;
}

int related(lua_State* L) {
    push_related(L, pointer_argument(L));
    return 1;
}

int nearest(lua_State* L) {
    const char* name = traversal_of(L).name.c_str();
    Vec3 place;
    if (lua_gettop(L) == 1) {
        place = vector_argument(L, 1, name);
    } else if (lua_gettop(L) == 3) {
        for (int i = 0; i < 3; ++i) place[i] = number_argument(L, i + 1, name);
    } else {
        throw Diagnostic(fmt::format("'{}' needs a place: three coordinates or one vector", name), {}, Fault::run);
    }
    push_related(L, {}, place);
    return 1;
}

/// (object, number from 1)
int numbered(lua_State* L) {
    const Handle owner = pointer_argument(L);
    const Traversal& traversal = traversal_of(L);
    const std::int64_t number = integer_argument(L, 2, traversal.name.c_str());
    if (number < 1) {
        const World& world = world_of(L);
        const auto to = static_cast<std::size_t>(world.relations()[traversal.relation].to);
        throw Diagnostic(fmt::format("'{}' counts {}s from 1, not {}", traversal.name, world.tables()[to].name, number),
                         {}, Fault::run);
    }
    push_related(L, owner, static_cast<std::size_t>(number - 1));
    return 1;
}

/// (object, name)
int property(lua_State* L) {
    const Handle owner = pointer_argument(L);
    push_fish_value(L, world_of(L).property(owner, text_argument(L, 2, traversal_of(L).name.c_str())));
    return 1;
}

/// (object, name, value)
int write_property(lua_State* L) {
    const Handle owner = pointer_argument(L);
    const std::string name = text_argument(L, 2, traversal_of(L).name.c_str());
    if (!is_restoring(L)) world_of(L).set_property(owner, name, number_argument(L, 3, traversal_of(L).name.c_str()));
    return 0;
}

/// (contact or sub-contact) and (contact or sub-contact, name): the name of its joint model, a property of it.
int joint(lua_State* L) {
    const std::int32_t sub_contacts = find_table(world_of(L), "sub_contact");
    Handle owner;
    if (lua_type(L, 1) == LUA_TLIGHTUSERDATA) owner = unpack_handle(lua_touserdata(L, 1));
    if (owner.generation == 0 || owner.table != sub_contacts) owner = pointer_argument(L);
    if (lua_gettop(L) == 2) {
        push_fish_value(L, world_of(L).property(owner, text_argument(L, 2, traversal_of(L).name.c_str())));
        return 1;
    }
    const auto& fields = world_of(L).tables()[owner.table].fields;
    const auto model = std::ranges::find(fields, "model", &FieldInfo::name);
    push_fish_value(L, world_of(L).get(owner, static_cast<std::size_t>(model - fields.begin())));
    return 1;
}

/// "b_extra", or "b_extra 2" for a second value: `index` is the stack place of its number.
std::string extra_name(lua_State* L, int index, bool given) {
    const std::string& name = traversal_of(L).name;
    const std::int64_t number = given ? integer_argument(L, index, name.c_str()) : 1;
    return number == 1 ? name : fmt::format("{} {}", name, number);
}

int read_extra(lua_State* L) {
    const Handle owner = pointer_argument(L);
    if (!world_of(L).alive(owner))
        throw Diagnostic(fmt::format("this {} no longer exists", table_name(L)), {}, Fault::run);
    const std::string name = extra_name(L, 2, lua_gettop(L) == 2);
    push_anchor(L, names_of(L).extras);
    lua_getfield(L, -1, name.c_str());
    if (lua_istable(L, -1)) {
        lua_rawgetp(L, -1, lua_touserdata(L, 1));
        if (!lua_isnil(L, -1)) return 1;
    }
    lua_pushinteger(L, 0);
    return 1;
}

int write_extra(lua_State* L) {
    pointer_argument(L);
    const int value = lua_gettop(L);
    const std::string name = extra_name(L, 2, value == 3);
    push_anchor(L, names_of(L).extras);
    if (lua_getfield(L, -1, name.c_str()) != LUA_TTABLE) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_pushvalue(L, -1);
        lua_setfield(L, -3, name.c_str());
    }
    lua_pushvalue(L, value);
    lua_rawsetp(L, -2, lua_touserdata(L, 1));
    return 0;
}

struct Reader {
    lua_CFunction read;
    int least, most;
};

Reader reader_of(const World& world, const Traversal& traversal) {
    using Form = RelationInfo::Form;
    switch (traversal.walk) {
    case Walk::property: return {guarded<property>, 2, 2};
    case Walk::joint: return {guarded<joint>, 1, 2};
    case Walk::extra: return {guarded<read_extra>, 1, 2};
    case Walk::relation: break;
    }
    const Form form = world.relations()[traversal.relation].form;
    if (form == Form::nearest) return {guarded<nearest>, 1, 3};
    if (form == Form::numbered) return {guarded<numbered>, 2, 2};
    if (traversal.table < 0) return {guarded<first_of_model>, 0, 0};
    return {guarded<related>, 1, 1};
}

/// All traversals of the tables and relations of the world.
std::vector<Traversal> traversals_of(const World& world) {
    std::vector<Traversal> all;
    const auto& relations = world.relations();
    for (std::size_t i = 0; i < relations.size(); ++i)
        if (!relations[i].classic.empty())
            all.push_back({std::string(relations[i].classic), Walk::relation, relations[i].from, i});
    const auto& tables = world.tables();
    for (std::size_t i = 0; i < tables.size(); ++i) {
        if (tables[i].classic.empty()) continue;
        const auto add = [&](const char* what, Walk walk) {
            all.push_back({fmt::format("{}_{}", tables[i].classic, what), walk, static_cast<std::int32_t>(i), 0});
        };
        const auto table = static_cast<std::int32_t>(i);
        if (const auto to_nearest = find_relation(world, RelationInfo::Form::nearest, -1, table); to_nearest >= 0)
            all.push_back(
                {fmt::format("{}_near", tables[i].classic), Walk::relation, -1, static_cast<std::size_t>(to_nearest)});
        if (tables[i].has_properties) add("prop", Walk::property);
        add("extra", Walk::extra);
        if (!tables[i].has_spares) continue;
        add("ispare", Walk::extra);
        add("rspare", Walk::extra);
    }
    const std::int32_t contacts = find_table(world, "contact");
    if (contacts < 0) return all;
    all.push_back({"j_prop", Walk::joint, contacts, 0});
    all.push_back({"j_model", Walk::joint, contacts, 0});
    return all;
}

} // namespace

void add_traversals(lua_State* L) {
    names_of(L).traversals = traversals_of(world_of(L));
    const std::int32_t sub_contacts = find_table(world_of(L), "sub_contact");
    for (std::size_t i = 0; i < names_of(L).traversals.size(); ++i) {
        const Traversal& traversal = names_of(L).traversals[i];
        if (traversal.walk == Walk::extra && names_of(L).built_ins.contains(traversal.name)) continue;
        const auto push = [&](lua_CFunction function) {
            lua_pushinteger(L, static_cast<lua_Integer>(i));
            lua_pushcclosure(L, function, 1);
        };
        const Reader reader = reader_of(world_of(L), traversal);
        push(reader.read);
        add_reader(L, traversal.name, reader.least, reader.most);
        const bool history = traversal.walk == Walk::property && traversal.table == sub_contacts;
        if (traversal.walk != Walk::extra && !history) continue;
        push(history ? guarded<write_property> : guarded<write_extra>);
        add_writer(L, traversal.name);
    }
}

} // namespace kaya::script
