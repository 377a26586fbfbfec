// Fields and global quantities of the world under their classic FISH names: cx_nforce(p), gp_xvel(p) = 1,
// time.
#include "lang/script/built_ins.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/handles.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/values.hpp"

#include <fmt/format.h>

namespace kaya::script {

namespace {

/// A field of a table as the one upvalue of its functions: these run millions of times, and every call into Lua adds time.
struct FieldKey {
    std::int32_t table;
    std::uint32_t field;
};

lua_Integer packed(FieldKey key) { return static_cast<lua_Integer>(key.table) << 32 | key.field; }

FieldKey key_of(lua_State* L) {
    const lua_Integer bits = lua_tointegerx(L, lua_upvalueindex(1), nullptr);
    return {static_cast<std::int32_t>(bits >> 32), static_cast<std::uint32_t>(bits)};
}

const FieldInfo& field_of(lua_State* L) {
    const FieldKey key = key_of(L);
    return machine_of(L).world.tables()[key.table].fields[key.field];
}

[[noreturn]] void fail_pointer(lua_State* L) {
    const Machine& machine = machine_of(L);
    const auto& table = machine.world.tables()[key_of(L).table];
    const bool null = lua_type(L, 1) == LUA_TNUMBER && lua_tonumber(L, 1) == 0;
    if (null)
        throw Diagnostic(fmt::format("'{}' is given a null pointer", field_of(L).classic),
                         fmt::format("test the pointer against 0 before its {} is used", table.name), Fault::run);
    throw Diagnostic(fmt::format("'{}' needs a pointer to a {}, here it is given {}", field_of(L).classic, table.name,
                                 describe_value(L, 1)),
                     {}, Fault::run);
}

int read_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const FieldKey key = key_of(L);
    if (handle.table != key.table) fail_pointer(L);
    push_fish_value(L, machine_of(L).world.get(handle, key.field));
    return 1;
}

int write_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const FieldKey key = key_of(L);
    if (handle.table != key.table) fail_pointer(L);
    Machine& machine = machine_of(L);
    if (!machine.restoring)
        machine.world.set(handle, key.field, value_at(L, 2, fmt::format("the new '{}'", field_of(L).classic)));
    return 0;
}

/// Upvalue of both: number of the quantity.
std::size_t global_of(lua_State* L) { return static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1))); }

int read_global(lua_State* L) {
    push_fish_value(L, machine_of(L).world.get(World::whole_model, global_of(L)));
    return 1;
}

int write_global(lua_State* L) {
    Machine& machine = machine_of(L);
    if (machine.restoring) return 0;
    const std::size_t number = global_of(L);
    machine.world.set(World::whole_model, number,
                      value_at(L, 1, fmt::format("the new '{}'", machine.world.globals()[number].name)));
    return 0;
}

void push_closure(lua_State* L, lua_CFunction function, lua_Integer upvalue) {
    lua_pushinteger(L, upvalue);
    lua_pushcclosure(L, function, 1);
}

} // namespace

void add_accessors(Machine& machine) {
    lua_State* L = machine.lua;
    const auto& tables = machine.world.tables();
    for (std::size_t t = 0; t < tables.size(); ++t)
        for (std::size_t i = 0; i < tables[t].fields.size(); ++i) {
            const FieldInfo& field = tables[t].fields[i];
            if (field.classic.empty()) continue;
            const lua_Integer key = packed({static_cast<std::int32_t>(t), static_cast<std::uint32_t>(i)});
            push_closure(L, guarded<read_field>, key);
            add_reader(machine, field.classic, 1, 1);
            if (!field.writable) continue;
            push_closure(L, guarded<write_field>, key);
            add_writer(machine, field.classic);
        }
    const auto& globals = machine.world.globals();
    for (std::size_t i = 0; i < globals.size(); ++i) {
        if (globals[i].classic.empty()) continue;
        push_closure(L, guarded<read_global>, static_cast<lua_Integer>(i));
        add_reader(machine, globals[i].classic, 0, 0);
        if (!globals[i].writable) continue;
        push_closure(L, guarded<write_global>, static_cast<lua_Integer>(i));
        add_writer(machine, globals[i].classic);
    }
}

} // namespace kaya::script
