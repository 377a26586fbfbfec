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
    {"mech.time", "time"},
    {"mech.timestep", "tdel"},
    {"mech.cycle", "cycle"},
    {"mech.step", "step"},
    {"mech.unbalanced", "unbal"},
    {"global.step", "step"},
    {"global.gravity", "grav"},
    {"global.gravity.x", "xgrav"},
    {"global.gravity.y", "ygrav"},
    {"global.gravity.z", "zgrav"},
    {"block.head", "block_head"},
    {"block.num", "nblock"},
    {"block.next", "b_next"},
    {"block.near", "b_near"},
    {"block.id", "b_id"},
    {"block.region", "b_region"},
    {"block.group", "b_group"},
    {"block.extra", "b_extra"},
    {"block.fix", "b_fix"},
    {"block.hidden", "b_hidden"},
    {"block.mass", "b_mass"},
    {"block.vol", "b_vol"},
    {"block.area", "b_area"},
    {"block.pos", "b_cent"},
    {"block.pos.x", "b_x"},
    {"block.pos.y", "b_y"},
    {"block.pos.z", "b_z"},
    {"block.vel", "b_vel"},
    {"block.vel.x", "b_xvel"},
    {"block.vel.y", "b_yvel"},
    {"block.vel.z", "b_zvel"},
    {"block.rvel", "b_rvel"},
    {"block.force.unbal", "b_force"},
    {"block.force.unbal.x", "b_xforce"},
    {"block.force.unbal.y", "b_yforce"},
    {"block.force.unbal.z", "b_zforce"},
    {"block.force.app", "b_load"},
    {"block.force.app.x", "b_xload"},
    {"block.force.app.y", "b_yload"},
    {"block.force.app.z", "b_zload"},
    {"block.moment", "b_mom"},
    {"block.moment.x", "b_xmom"},
    {"block.moment.y", "b_ymom"},
    {"block.moment.z", "b_zmom"},
    {"block.contact.head", "contact_head"},
    {"block.contact.id", "c_id"},
    {"block.contact.next", "c_next"},
    {"block.contact.near", "c_near"},
    {"block.contact.type", "c_type"},
    {"block.contact.b1", "c_b1"},
    {"block.contact.b2", "c_b2"},
    {"block.contact.pos", "c_pos"},
    {"block.contact.pos.x", "c_x"},
    {"block.contact.pos.y", "c_y"},
    {"block.contact.pos.z", "c_z"},
    {"block.contact.normal", "c_n"},
    {"block.contact.normal.x", "c_nx"},
    {"block.contact.normal.y", "c_ny"},
    {"block.contact.normal.z", "c_nz"},
    {"block.contact.area", "c_area"},
    {"block.contact.jset", "c_jset"},
    {"block.contact.extra", "c_extra"},
    {"block.contact.model", "c_model"},
    {"block.contact.prop", "c_prop"},
    {"block.subcontact.id", "cx_id"},
    {"block.subcontact.next", "cx_next"},
    {"block.subcontact.near", "cx_near"},
    {"block.subcontact.type", "cx_type"},
    {"block.subcontact.contact", "cx_contact"},
    {"block.subcontact.pos", "cx_pos"},
    {"block.subcontact.pos.x", "cx_x"},
    {"block.subcontact.pos.y", "cx_y"},
    {"block.subcontact.pos.z", "cx_z"},
    {"block.subcontact.area", "cx_area"},
    {"block.subcontact.gp", "cx_vertex"},
    {"block.subcontact.face", "cx_face"},
    {"block.subcontact.model", "cx_model"},
    {"block.subcontact.prop", "cx_prop"},
    {"block.subcontact.disp.norm", "cx_ndis"},
    {"block.subcontact.disp.shear", "cx_sdis"},
    {"block.subcontact.disp.shear.x", "cx_xsdis"},
    {"block.subcontact.disp.shear.y", "cx_ysdis"},
    {"block.subcontact.disp.shear.z", "cx_zsdis"},
    {"block.subcontact.force.norm", "cx_nforce"},
    {"block.subcontact.force.shear", "cx_sforce"},
    {"block.subcontact.force.shear.x", "cx_xsforce"},
    {"block.subcontact.force.shear.y", "cx_ysforce"},
    {"block.subcontact.force.shear.z", "cx_zsforce"},
    {"block.subcontact.pp", "cx_pp"},
    {"block.subcontact.force.pp", "cx_ppforce"},
    {"block.subcontact.state", "cx_state"},
    {"block.subcontact.extra", "cx_extra"},
    {"block.gp.id", "gp_id"},
    {"block.gp.next", "gp_next"},
    {"block.gp.near", "gp_near"},
    {"block.gp.hostblock", "gp_block"},
    {"block.gp.pos", "gp_pos"},
    {"block.gp.pos.x", "gp_x"},
    {"block.gp.pos.y", "gp_y"},
    {"block.gp.pos.z", "gp_z"},
    {"block.gp.vel", "gp_vel"},
    {"block.gp.vel.x", "gp_xvel"},
    {"block.gp.vel.y", "gp_yvel"},
    {"block.gp.vel.z", "gp_zvel"},
    {"block.gp.disp", "gp_dis"},
    {"block.gp.disp.x", "gp_xdis"},
    {"block.gp.disp.y", "gp_ydis"},
    {"block.gp.disp.z", "gp_zdis"},
    {"block.gp.mass", "gp_mass"},
    {"block.gp.force.unbal", "gp_force"},
    {"block.gp.force.app", "gp_load"},
    {"block.gp.force.reaction", "gp_reaction"},
    {"block.gp.extra", "gp_extra"},
    {"block.gp.group", "gp_group"},
    {"block.zone.id", "z_id"},
    {"block.zone.next", "z_next"},
    {"block.zone.near", "z_near"},
    {"block.zone.hostblock", "z_block"},
    {"block.zone.gp", "z_gp"},
    {"block.zone.pos", "z_cen"},
    {"block.zone.pos.x", "z_x"},
    {"block.zone.pos.y", "z_y"},
    {"block.zone.pos.z", "z_z"},
    {"block.zone.vol", "z_vol"},
    {"block.zone.mass", "z_mass"},
    {"block.zone.stress.xx", "z_sxx"},
    {"block.zone.stress.yy", "z_syy"},
    {"block.zone.stress.zz", "z_szz"},
    {"block.zone.stress.xy", "z_sxy"},
    {"block.zone.stress.xz", "z_sxz"},
    {"block.zone.stress.yz", "z_syz"},
    {"block.zone.stress.prin.min", "z_sig1"},
    {"block.zone.stress.prin.max", "z_sig3"},
    {"block.zone.prop", "z_prop"},
    {"block.zone.group", "z_group"},
    {"block.zone.extra", "z_extra"},
    {"block.face.next", "face_next"},
    {"block.face.near", "face_near"},
    {"block.face.hostblock", "face_block"},
    {"block.face.pos", "face_pos"},
    {"block.face.normal", "face_n"},
    {"block.face.area", "face_area"},
    {"block.face.jset", "face_jset"},
    {"block.face.ngp", "face_ngp"},
    {"block.face.gp", "face_gp"},
    {"block.face.extra", "face_extra"},
};

struct List {
    std::string_view name, table, parent;
};

/// Lists of all objects, or of those of one parent.
constexpr List lists[] = {
    {"block.list", "block", ""},
    {"block.contact.list", "contact", ""},
    {"block.subcontact.list", "sub_contact", ""},
    {"block.gp.list", "gridpoint", ""},
    {"block.zone.list", "zone", ""},
    {"block.face.list", "face", ""},
    {"block.gplist", "gridpoint", "block"},
    {"block.zonelist", "zone", "block"},
    {"block.facelist", "face", "block"},
    {"block.contact.subcontactlist", "sub_contact", "contact"},
};

const List& list_of(lua_State* L) { return lists[static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))]; }

/// Makes an array of one dimension of the table at the top of the stack.
int as_array(lua_State* L, lua_Integer size) {
    lua_createtable(L, 1, 0);
    lua_pushinteger(L, size);
    lua_rawseti(L, -2, 1);
    lua_setfield(L, -2, "dimensions");
    push_anchor(L, machine_of(L).anchors.runtime);
    lua_getfield(L, -1, "as_array");
    lua_pushvalue(L, -3);
    lua_call(L, 1, 1);
    return 1;
}

int list_all(lua_State* L) {
    World& world = machine_of(L).world;
    const std::int32_t table = find_table(world, list_of(L).table);
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
    const std::int32_t table = find_table(world, list_of(L).table), parent = find_table(world, list_of(L).parent);
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const Handle owner = pointer ? unpack_handle(lua_touserdata(L, 1)) : Handle{};
    if (!pointer || owner.table != parent)
        fail_argument(L, 1, list_of(L).name.data(), fmt::format("a pointer to a {}", list_of(L).parent).c_str());
    lua_newtable(L);
    lua_Integer count = 0;
    for (Handle child = world.first_child(owner, table); child.generation != 0; child = world.next(child)) {
        lua_pushlightuserdata(L, pack_handle(child));
        lua_rawseti(L, -2, ++count);
    }
    return as_array(L, count);
}

void add_alias(Machine& machine, const Alias& alias) {
    const auto found = machine.fish.built_ins.find(alias.classic);
    if (found == machine.fish.built_ins.end()) return; // the world has no such field
    const BuiltIn built_in = found->second;
    lua_State* L = machine.lua;
    const auto push = [&](int anchor) {
        push_anchor(L, anchor);
        lua_pushlstring(L, alias.classic.data(), alias.classic.size());
        lua_rawget(L, -2);
        lua_remove(L, -2);
    };
    push(machine.anchors.readers);
    add_reader(machine, alias.modern, built_in.least, built_in.most);
    if (!built_in.writable) return;
    push(machine.anchors.writers);
    add_writer(machine, alias.modern);
}

} // namespace

std::vector<std::pair<std::string, std::string>> modern_names() {
    std::vector<std::pair<std::string, std::string>> names;
    for (const auto& alias : aliases) names.emplace_back(alias.modern, alias.classic);
    return names;
}

void add_modern_names(Machine& machine) {
    for (const auto& alias : aliases) add_alias(machine, alias);
    for (std::size_t i = 0; i < std::size(lists); ++i) {
        const List& list = lists[i];
        if (find_table(machine.world, list.table) < 0) continue;
        if (!list.parent.empty() && find_table(machine.world, list.parent) < 0) continue;
        const bool all = list.parent.empty();
        lua_pushinteger(machine.lua, static_cast<lua_Integer>(i));
        lua_pushcclosure(machine.lua, all ? guarded<list_all> : guarded<list_children>, 1);
        add_reader(machine, list.name, all ? 0 : 1, all ? 0 : 1);
    }
}

} // namespace kaya::script
