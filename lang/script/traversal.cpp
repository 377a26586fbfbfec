// How FISH walks over lists of the model: heads, next links, children, nearest objects; and b_extra, c_extra,
// ...
#include "lang/script/built_ins.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handles.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

enum class Walk { head, next, child, nearest, gridpoint, property, joint, side, extra };

struct Traversal {
    const char* name;
    Walk walk;
    const char* table; ///< that the argument is in, or that the list is made of
    const char* child = "";
};

constexpr std::array<Traversal, 45> traversals{{
    {"block_head", Walk::head, "block"},
    {"contact_head", Walk::head, "contact"},
    {"b_next", Walk::next, "block"},
    {"c_next", Walk::next, "contact"},
    {"cx_next", Walk::next, "sub_contact"},
    {"gp_next", Walk::next, "gridpoint"},
    {"z_next", Walk::next, "zone"},
    {"face_next", Walk::next, "face"},
    {"c_cx", Walk::child, "contact", "sub_contact"},
    {"b_gp", Walk::child, "block", "gridpoint"},
    {"b_zone", Walk::child, "block", "zone"},
    {"b_face", Walk::child, "block", "face"},
    {"b_near", Walk::nearest, "block"},
    {"c_near", Walk::nearest, "contact"},
    {"cx_near", Walk::nearest, "sub_contact"},
    {"gp_near", Walk::nearest, "gridpoint"},
    {"z_near", Walk::nearest, "zone"},
    {"face_near", Walk::nearest, "face"},
    {"z_gp", Walk::gridpoint, "zone"},
    {"face_gp", Walk::gridpoint, "face"},
    {"c_prop", Walk::property, "contact"},
    {"cx_prop", Walk::property, "sub_contact"},
    {"z_prop", Walk::property, "zone"},
    {"j_prop", Walk::joint, "contact"},
    {"j_model", Walk::joint, "contact"},
    {"c_link1", Walk::side, "contact"},
    {"c_link2", Walk::side, "contact"},
    {"face_vlist", Walk::child, "face", "corner"},
    {"vl_next", Walk::next, "corner"},
    {"b_extra", Walk::extra, "block"},
    {"c_extra", Walk::extra, "contact"},
    {"cx_extra", Walk::extra, "sub_contact"},
    {"gp_extra", Walk::extra, "gridpoint"},
    {"z_extra", Walk::extra, "zone"},
    {"face_extra", Walk::extra, "face"},
    {"b_ispare", Walk::extra, "block"},
    {"b_rspare", Walk::extra, "block"},
    {"c_ispare", Walk::extra, "contact"},
    {"c_rspare", Walk::extra, "contact"},
    {"cx_ispare", Walk::extra, "sub_contact"},
    {"cx_rspare", Walk::extra, "sub_contact"},
    {"gp_ispare", Walk::extra, "gridpoint"},
    {"gp_rspare", Walk::extra, "gridpoint"},
    {"z_ispare", Walk::extra, "zone"},
    {"z_rspare", Walk::extra, "zone"},
}};

const Traversal& traversal_of(lua_State* L) {
    return traversals[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))];
}
std::int32_t table_of(lua_State* L) {
    return static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(2)));
}

/// Upvalues of all: number of the traversal, of its table, of its child table.
Handle pointer_argument(lua_State* L) {
    if (lua_type(L, 1) == LUA_TLIGHTUSERDATA) {
        const Handle handle = unpack_handle(lua_touserdata(L, 1));
        if (handle.table == table_of(L)) return handle;
    }
    const Traversal& traversal = traversal_of(L);
    if (lua_type(L, 1) == LUA_TNUMBER && lua_tonumber(L, 1) == 0)
        throw Diagnostic(fmt::format("'{}' is given a null pointer", traversal.name),
                         "test the pointer against 0 before it is used", Fault::run);
    throw Diagnostic(fmt::format("'{}' needs a pointer to a {}, here it is given {}", traversal.name,
                                 traversal.table, describe_value(L, 1)),
                     {}, Fault::run);
}

void push_handle(lua_State* L, const Handle& handle) {
    if (handle.generation == 0)
        lua_pushinteger(L, 0);
    else
        lua_pushlightuserdata(L, pack_handle(handle));
}

int head(lua_State* L) {
    World& world = machine_of(L).world;
    push_handle(L, world.count(table_of(L)) > 0 ? world.at(table_of(L), 0) : Handle{});
    return 1;
}

int next(lua_State* L) {
    push_handle(L, machine_of(L).world.next(pointer_argument(L)));
    return 1;
}

int child(lua_State* L) {
    const Handle parent = pointer_argument(L);
    push_handle(L, machine_of(L).world.first_child(
                       parent, static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(3)))));
    return 1;
}

int nearest(lua_State* L) {
    const char* name = traversal_of(L).name;
    Vec3 place;
    if (lua_gettop(L) == 1) {
        place = vector_argument(L, 1, name);
    } else if (lua_gettop(L) == 3) {
        for (int i = 0; i < 3; ++i) place[i] = number_argument(L, i + 1, name);
    } else {
        throw Diagnostic(fmt::format("'{}' needs a place: three coordinates or one vector", name), {},
                         Fault::run);
    }
    push_handle(L, machine_of(L).world.nearest(table_of(L), place));
    return 1;
}

/// (object, number from 1)
int gridpoint(lua_State* L) {
    const Handle owner = pointer_argument(L);
    const std::int64_t number = integer_argument(L, 2, traversal_of(L).name);
    if (number < 1)
        throw Diagnostic(fmt::format("'{}' counts gridpoints from 1, not {}", traversal_of(L).name, number), {},
                         Fault::run);
    push_handle(L, machine_of(L).world.gridpoint_of(owner, static_cast<std::size_t>(number - 1)));
    return 1;
}

/// (object, name)
int property(lua_State* L) {
    const Handle owner = pointer_argument(L);
    push_fish_value(L, machine_of(L).world.property(owner, text_argument(L, 2, traversal_of(L).name)));
    return 1;
}

/// (object, name, value)
int write_property(lua_State* L) {
    const Handle owner = pointer_argument(L);
    const std::string name = text_argument(L, 2, traversal_of(L).name);
    if (!machine_of(L).restoring) machine_of(L).world.set_property(owner, name, number_argument(L, 3, traversal_of(L).name));
    return 0;
}

/// (contact or sub-contact) and (contact or sub-contact, name): the name of its joint model, a property of it.
int joint(lua_State* L) {
    Machine& machine = machine_of(L);
    const std::int32_t sub_contacts = find_table(machine.world, "sub_contact");
    Handle owner;
    if (lua_type(L, 1) == LUA_TLIGHTUSERDATA) owner = unpack_handle(lua_touserdata(L, 1));
    if (owner.generation == 0 || owner.table != sub_contacts) owner = pointer_argument(L);
    if (lua_gettop(L) == 2) {
        push_fish_value(L, machine.world.property(owner, text_argument(L, 2, traversal_of(L).name)));
        return 1;
    }
    const auto& fields = machine.world.tables()[owner.table].fields;
    const auto model = std::ranges::find(fields, "model", &FieldInfo::name);
    push_fish_value(L, machine.world.get(owner, static_cast<std::size_t>(model - fields.begin())));
    return 1;
}

/// c_link1, c_link2: the last letter says whose list is walked.
int side(lua_State* L) {
    const Handle contact = pointer_argument(L);
    push_handle(L, machine_of(L).world.next_of_block(contact, std::string_view(traversal_of(L).name).back() - '0'));
    return 1;
}

/// "b_extra", or "b_extra 2" for a second value: `index` is the stack place of its number.
std::string extra_name(lua_State* L, int index, bool given) {
    const char* name = traversal_of(L).name;
    const std::int64_t number = given ? integer_argument(L, index, name) : 1;
    return number == 1 ? name : fmt::format("{} {}", name, number);
}

int read_extra(lua_State* L) {
    const Handle owner = pointer_argument(L);
    if (!machine_of(L).world.alive(owner))
        throw Diagnostic(fmt::format("this {} no longer exists", traversal_of(L).table), {}, Fault::run);
    const std::string name = extra_name(L, 2, lua_gettop(L) == 2);
    push_anchor(L, machine_of(L).anchors.extras);
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
    push_anchor(L, machine_of(L).anchors.extras);
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

struct Kind {
    lua_CFunction read;
    int least, most;
};

Kind kind_of(Walk walk) {
    switch (walk) {
    case Walk::head:
        return {guarded<head>, 0, 0};
    case Walk::next:
        return {guarded<next>, 1, 1};
    case Walk::child:
        return {guarded<child>, 1, 1};
    case Walk::nearest:
        return {guarded<nearest>, 1, 3};
    case Walk::gridpoint:
        return {guarded<gridpoint>, 2, 2};
    case Walk::property:
        return {guarded<property>, 2, 2};
    case Walk::joint:
        return {guarded<joint>, 1, 2};
    case Walk::side:
        return {guarded<side>, 1, 1};
    case Walk::extra:
        break;
    }
    return {guarded<read_extra>, 1, 2};
}

} // namespace

void add_traversals(Machine& machine) {
    lua_State* L = machine.lua;
    for (std::size_t i = 0; i < traversals.size(); ++i) {
        const Traversal& traversal = traversals[i];
        const std::int32_t table = find_table(machine.world, traversal.table);
        const std::int32_t child_table = find_table(machine.world, traversal.child);
        const bool needs_child = traversal.walk == Walk::child;
        if (table < 0 || (needs_child && child_table < 0)) continue;
        if (traversal.walk == Walk::extra && machine.fish.built_ins.contains(traversal.name)) continue;
        const auto push = [&](lua_CFunction function) {
            lua_pushinteger(L, static_cast<lua_Integer>(i));
            lua_pushinteger(L, table);
            lua_pushinteger(L, child_table);
            lua_pushcclosure(L, function, 3);
        };
        const Kind kind = kind_of(traversal.walk);
        push(kind.read);
        add_reader(machine, traversal.name, kind.least, kind.most);
        const bool history = traversal.walk == Walk::property && traversal.table == std::string_view("sub_contact");
        if (traversal.walk != Walk::extra && !history) continue;
        push(history ? guarded<write_property> : guarded<write_extra>);
        add_writer(machine, traversal.name);
    }
}

} // namespace kaya::script
