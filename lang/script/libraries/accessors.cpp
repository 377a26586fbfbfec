// Fields and global quantities of the world under their names in FISH, classic and modern: cx_nforce(p), gp_xvel(p) = 1, time,
// block.gp.vel(p), block.gp.vel(p, 1), block.zone.stress(z).
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/state/compounds.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <array>
#include <fmt/format.h>
#include <iterator>

namespace kaya::script {

namespace {

/// A field of a table as the one upvalue of its functions: these run millions of times, and every call into Lua adds time.
struct FieldKey {
    std::int32_t table;
    std::uint32_t field;
    bool modern; ///< called by its modern name: for messages
};
constexpr std::uint32_t modern_bit = 1u << 31;

lua_Integer packed(FieldKey key) {
    return static_cast<lua_Integer>(key.table) << 32 | key.field | (key.modern ? modern_bit : 0);
}

FieldKey key_of(lua_State* L) {
    const lua_Integer bits = lua_tointegerx(L, lua_upvalueindex(1), nullptr);
    const auto field = static_cast<std::uint32_t>(bits);
    return {static_cast<std::int32_t>(bits >> 32), field & ~modern_bit, (field & modern_bit) != 0};
}

const FieldInfo& field_of(lua_State* L) {
    const FieldKey key = key_of(L);
    return world_of(L).tables()[key.table].fields[key.field];
}

/// As the function was called.
std::string_view called(lua_State* L) { return key_of(L).modern ? field_of(L).modern : field_of(L).classic; }

[[noreturn]] void fail_pointer(lua_State* L, std::string_view name) {
    const auto& table = world_of(L).tables()[key_of(L).table];
    const bool null = lua_type(L, 1) == LUA_TNUMBER && lua_tonumber(L, 1) == 0;
    if (null)
        throw Diagnostic(fmt::format("'{}' is given a null pointer", name),
                         fmt::format("test the pointer against 0 before its {} is used", table.name), Fault::run);
    throw Diagnostic(
        fmt::format("'{}' needs a pointer to a {}, here it is given {}", name, table.name, describe_value(L, 1)), {},
        Fault::run);
}
[[noreturn]] void fail_pointer(lua_State* L) { fail_pointer(L, called(L)); }

int read_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const FieldKey key = key_of(L);
    if (handle.table != key.table) fail_pointer(L);
    push_fish_value(L, world_of(L).get(handle, key.field));
    return 1;
}

int write_field(lua_State* L) {
    if (lua_type(L, 1) != LUA_TLIGHTUSERDATA) fail_pointer(L);
    const Handle handle = unpack_handle(lua_touserdata(L, 1));
    const FieldKey key = key_of(L);
    if (handle.table != key.table) fail_pointer(L);
    if (!is_restoring(L)) world_of(L).set(handle, key.field, value_at(L, 2, fmt::format("the new '{}'", called(L))));
    return 0;
}

/// The number of a component, from 0: (pointer, 1 to 3).
int component_argument(lua_State* L) {
    const std::int64_t number = integer_argument(L, 2, std::string(called(L)).c_str());
    if (number < 1 || number > 3)
        throw Diagnostic(fmt::format("'{}' has the components 1, 2 and 3, not {}", called(L), number), {}, Fault::run);
    return static_cast<int>(number) - 1;
}

/// The vector at the top of the stack.
Vec3 vector_of_field(lua_State* L) {
    if (!is_vector(L, -1))
        throw Diagnostic(fmt::format("'{}' is {} and has no components", called(L), describe_value(L, -1)),
                         "leave the number out", Fault::run);
    return vector_at(L, -1);
}

/// (pointer) and (pointer, number of the component)
int read_modern_field(lua_State* L) {
    const bool part = lua_gettop(L) == 2;
    const int component = part ? component_argument(L) : 0;
    read_field(L);
    if (part) lua_pushnumber(L, vector_of_field(L)[component]);
    return 1;
}

/// The same with the new value behind.
int write_modern_field(lua_State* L) {
    if (lua_gettop(L) == 2) return write_field(L);
    const int component = component_argument(L);
    const double value = number_argument(L, 3, std::string(called(L)).c_str());
    lua_settop(L, 1);
    read_field(L);
    Vec3 vector = vector_of_field(L);
    vector[component] = value;
    lua_settop(L, 1);
    push_vector(L, vector);
    return write_field(L);
}

/// Six fields under one name.
struct TensorNames {
    std::string_view modern, table;
    std::array<std::string_view, 6> fields;
};
constexpr TensorNames tensors[] = {
    {"block.zone.stress", "zone", {"xx_stress", "yy_stress", "zz_stress", "xy_stress", "xz_stress", "yz_stress"}}};

/// Upvalues: the table and the first of the six fields, the number of the row of `tensors`.
std::array<std::size_t, 6> tensor_fields(lua_State* L, const TensorNames& tensor) {
    const auto& fields = world_of(L).tables()[key_of(L).table].fields;
    std::array<std::size_t, 6> found{};
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = static_cast<std::size_t>(find_field(fields, tensor.fields[i]));
    return found;
}

Handle tensor_owner(lua_State* L, const TensorNames& tensor) {
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const Handle handle = pointer ? unpack_handle(lua_touserdata(L, 1)) : Handle{};
    if (!pointer || handle.table != key_of(L).table) fail_pointer(L, tensor.modern);
    return handle;
}

const TensorNames& tensor_of(lua_State* L) { return tensors[lua_tointeger(L, lua_upvalueindex(2))]; }

/// (pointer), (pointer, 1 to 6), (pointer, row, column)
int read_tensor(lua_State* L) {
    const TensorNames& tensor = tensor_of(L);
    const Handle handle = tensor_owner(L, tensor);
    const int indices = lua_gettop(L) - 1;
    push_runtime(L, "new_tensor");
    for (const std::size_t field : tensor_fields(L, tensor)) push_fish_value(L, world_of(L).get(handle, field));
    lua_call(L, 6, 1);
    if (indices == 0) return 1;
    push_runtime(L, indices == 1 ? "element" : "element_of");
    lua_pushvalue(L, -2);
    lua_pushlstring(L, tensor.modern.data(), tensor.modern.size());
    for (int i = 0; i < indices; ++i) lua_pushvalue(L, i + 2);
    lua_call(L, indices + 2, 1);
    return 1;
}

/// (pointer, tensor)
int write_tensor(lua_State* L) {
    const TensorNames& tensor = tensor_of(L);
    const Handle handle = tensor_owner(L, tensor);
    if (kind_of_value(L, 2) != "tensor")
        throw Diagnostic(
            fmt::format("the new '{}' must be a tensor, here it is {}", tensor.modern, describe_value(L, 2)),
            "write: tensor(xx, yy, zz, xy, xz, yz)", Fault::run);
    if (is_restoring(L)) return 0;
    lua_Integer i = 0;
    for (const std::size_t field : tensor_fields(L, tensor)) {
        lua_rawgeti(L, 2, ++i);
        world_of(L).set(handle, field, value_at(L, -1, "the new stress"));
        lua_pop(L, 1);
    }
    return 0;
}

/// Upvalue of both: number of the quantity.
std::size_t global_of(lua_State* L) { return static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1))); }

int read_global(lua_State* L) {
    push_fish_value(L, world_of(L).get(World::whole_model, global_of(L)));
    return 1;
}

int write_global(lua_State* L) {
    if (is_restoring(L)) return 0;
    const std::size_t number = global_of(L);
    world_of(L).set(World::whole_model, number,
                    value_at(L, 1, fmt::format("the new '{}'", world_of(L).globals()[number].name)));
    return 0;
}

void push_closure(lua_State* L, lua_CFunction function, lua_Integer upvalue) {
    lua_pushinteger(L, upvalue);
    lua_pushcclosure(L, function, 1);
}

void add_tensors(lua_State* L) {
    for (std::size_t i = 0; i < std::size(tensors); ++i) {
        const std::int32_t table = find_table(world_of(L), tensors[i].table);
        if (table < 0) continue;
        const auto push = [&](lua_CFunction function) {
            lua_pushinteger(L, packed({table, 0, true}));
            lua_pushinteger(L, static_cast<lua_Integer>(i));
            lua_pushcclosure(L, function, 2);
        };
        push(guarded<read_tensor>);
        add_reader(L, tensors[i].modern, 1, 3);
        push(guarded<write_tensor>);
        add_writer(L, tensors[i].modern);
    }
}

/// The field under one of its names.
void add_field(lua_State* L, const FieldInfo& field, FieldKey key) {
    const std::string_view name = key.modern ? field.modern : field.classic;
    if (name.empty()) return;
    push_closure(L, key.modern ? guarded<read_modern_field> : guarded<read_field>, packed(key));
    add_reader(L, name, 1, key.modern ? 2 : 1);
    if (!field.writable) return;
    push_closure(L, key.modern ? guarded<write_modern_field> : guarded<write_field>, packed(key));
    add_writer(L, name);
}

} // namespace

void add_accessors(lua_State* L) {
    const auto& tables = world_of(L).tables();
    for (std::size_t t = 0; t < tables.size(); ++t)
        for (std::size_t i = 0; i < tables[t].fields.size(); ++i)
            for (const bool modern : {false, true})
                add_field(L, tables[t].fields[i],
                          {static_cast<std::int32_t>(t), static_cast<std::uint32_t>(i), modern});
    add_tensors(L);
    const auto& globals = world_of(L).globals();
    for (std::size_t i = 0; i < globals.size(); ++i)
        for (const auto name : {globals[i].classic, globals[i].modern}) {
            if (name.empty()) continue;
            push_closure(L, guarded<read_global>, static_cast<lua_Integer>(i));
            add_reader(L, name, 0, 0);
            if (!globals[i].writable) continue;
            push_closure(L, guarded<write_global>, static_cast<lua_Integer>(i));
            add_writer(L, name);
        }
}

} // namespace kaya::script
