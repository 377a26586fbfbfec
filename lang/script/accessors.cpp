// Fields and global quantities of the world under their classic FISH names: cx_nforce(p), gp_xvel(p) = 1, time.
#include "lang/script/built_ins.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handles.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/values.hpp"

#include <fmt/format.h>

namespace kaya::script {

namespace {

std::int32_t upvalue(lua_State* L, int number) {
    return static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(number)));
}

const FieldInfo& field_of(lua_State* L) {
    return machine_of(L).world.tables()[upvalue(L, 1)].fields[upvalue(L, 2)];
}

[[noreturn]] void fail_pointer(lua_State* L) {
    const Machine& machine = machine_of(L);
    const auto& table = machine.world.tables()[upvalue(L, 1)];
    const bool null = lua_type(L, 1) == LUA_TNUMBER && lua_tonumber(L, 1) == 0;
    if (null)
        throw Diagnostic(fmt::format("'{}' is given a null pointer", field_of(L).classic),
                         fmt::format("test the pointer against 0 before its {} is used", table.name), Fault::run);
    throw Diagnostic(fmt::format("'{}' needs a pointer to a {}, here it is given {}", field_of(L).classic, table.name,
                                 describe_value(L, 1)),
                     {}, Fault::run);
}

/// Upvalues of both: number of the table, number of the field.
int read_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    if (handle.table != upvalue(L, 1)) fail_pointer(L);
    push_fish_value(L, machine_of(L).world.get(handle, static_cast<std::size_t>(upvalue(L, 2))));
    return 1;
}

int write_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    if (handle.table != upvalue(L, 1)) fail_pointer(L);
    Machine& machine = machine_of(L);
    if (machine.restoring) return 0;
    const auto& field = field_of(L);
    machine.world.set(handle, static_cast<std::size_t>(upvalue(L, 2)),
                      value_at(L, 2, fmt::format("the new '{}'", field.classic)));
    return 0;
}

/// Upvalue of both: number of the quantity.
int read_global(lua_State* L) {
    push_fish_value(L, machine_of(L).world.get_global(static_cast<std::size_t>(upvalue(L, 1))));
    return 1;
}

int write_global(lua_State* L) {
    Machine& machine = machine_of(L);
    if (machine.restoring) return 0;
    const auto number = static_cast<std::size_t>(upvalue(L, 1));
    machine.world.set_global(number, value_at(L, 1, fmt::format("the new '{}'", machine.world.globals()[number].name)));
    return 0;
}

void push_closure(lua_State* L, lua_CFunction function, std::size_t first, std::ptrdiff_t second = -1) {
    lua_pushinteger(L, static_cast<lua_Integer>(first));
    if (second >= 0) lua_pushinteger(L, static_cast<lua_Integer>(second));
    lua_pushcclosure(L, function, second >= 0 ? 2 : 1);
}

} // namespace

void add_accessors(Machine& machine) {
    lua_State* L = machine.lua;
    const auto& tables = machine.world.tables();
    for (std::size_t t = 0; t < tables.size(); ++t)
        for (std::size_t i = 0; i < tables[t].fields.size(); ++i) {
            const FieldInfo& field = tables[t].fields[i];
            if (field.classic.empty()) continue;
            push_closure(L, guarded<read_field>, t, static_cast<std::ptrdiff_t>(i));
            add_reader(machine, field.classic, 1, 1);
            if (!field.writable) continue;
            push_closure(L, guarded<write_field>, t, static_cast<std::ptrdiff_t>(i));
            add_writer(machine, field.classic);
        }
    const auto& globals = machine.world.globals();
    for (std::size_t i = 0; i < globals.size(); ++i) {
        if (globals[i].classic.empty()) continue;
        push_closure(L, guarded<read_global>, i);
        add_reader(machine, globals[i].classic, 0, 0);
        if (!globals[i].writable) continue;
        push_closure(L, guarded<write_global>, i);
        add_writer(machine, globals[i].classic);
    }
}

} // namespace kaya::script
