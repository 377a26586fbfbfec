// Functions that every kind of object has in modern FISH: block.find(7), block.gp.num, block.zone.maxid, block.contact.isgroup(c, 'a'),
// block.contactlist(b).
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/field_index.hpp"
#include "lang/script/values/handles.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::script {

namespace {

/// The upvalue of all functions: number of the table.
std::int32_t table_of(lua_State* L) { return static_cast<std::int32_t>(lua_tointeger(L, lua_upvalueindex(1))); }
const TableInfo& info_of(lua_State* L) { return world_of(L).tables()[static_cast<std::size_t>(table_of(L))]; }

void push_object(lua_State* L, const Handle& handle) {
    if (handle.generation == 0) lua_pushinteger(L, 0);
    else lua_pushlightuserdata(L, pack_handle(handle));
}

std::int64_t id_of(World& world, const Handle& handle, std::size_t field) {
    const Value id = world.get(handle, field);
    const auto* number = std::get_if<std::int64_t>(&id);
    return number ? *number : 0;
}

std::size_t id_field(lua_State* L) { return static_cast<std::size_t>(find_field(info_of(L).fields, "id")); }

/// (number): the object, null when there is none. Numbers grow with the rows unless objects were deleted, so the row is near.
int find_object(lua_State* L) {
    World& world = world_of(L);
    const std::int64_t wanted = integer_argument(L, 1, fmt::format("{}.find", info_of(L).modern).c_str());
    const std::size_t field = id_field(L), count = world.count(table_of(L));
    const auto start = static_cast<std::size_t>(std::clamp<std::int64_t>(wanted, 0, static_cast<std::int64_t>(count)));
    const auto fits = [&](std::size_t row) { return id_of(world, world.at(table_of(L), row), field) == wanted; };
    std::size_t row = start;
    while (row > 0 && !fits(row - 1)) --row;
    if (row > 0) {
        --row;
    } else {
        row = start;
        while (row < count && !fits(row)) ++row;
    }
    push_object(L, row < count ? world.at(table_of(L), row) : Handle{});
    return 1;
}

int count_objects(lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(world_of(L).count(table_of(L))));
    return 1;
}

int first_object(lua_State* L) {
    push_object(L, world_of(L).at(table_of(L), 0));
    return 1;
}

int greatest_id(lua_State* L) {
    World& world = world_of(L);
    std::int64_t greatest = 0;
    const std::size_t field = id_field(L);
    for (std::size_t row = world.count(table_of(L)); row-- > 0;)
        greatest = std::max(greatest, id_of(world, world.at(table_of(L), row), field));
    lua_pushinteger(L, greatest);
    return 1;
}

/// The first argument.
Handle object_argument(lua_State* L, const std::string& function) {
    const bool pointer = lua_type(L, 1) == LUA_TLIGHTUSERDATA;
    const Handle handle = pointer ? unpack_handle(lua_touserdata(L, 1)) : Handle{};
    if (!pointer || handle.table != table_of(L))
        throw Diagnostic(fmt::format("'{}' needs a pointer to a {}, here it is given {}", function, info_of(L).name,
                                     describe_value(L, 1)),
                         {}, Fault::run);
    return handle;
}

/// (object, name[, slot]): 1 when it is in the group, whatever the case of its letters
int in_group(lua_State* L) {
    const std::string function = fmt::format("{}.isgroup", info_of(L).modern);
    const Handle handle = object_argument(L, function);
    std::string name = text_argument(L, 2, function.c_str());
    if (lua_gettop(L) > 2) {
        const bool number = lua_isinteger(L, 3) != 0; // slots may be numbers
        name = fmt::format("{}={}",
                           number ? std::to_string(lua_tointeger(L, 3)) : text_argument(L, 3, function.c_str()), name);
    }
    lua_pushinteger(L, world_of(L).in_group(handle, name) ? 1 : 0);
    return 1;
}

/// (block): the contacts that it takes part in. The upvalue is the table of blocks.
int contacts_of(lua_State* L) {
    World& world = world_of(L);
    const Handle block = object_argument(L, "block.contactlist");
    if (!world.alive(block)) throw Diagnostic("this block no longer exists", {}, Fault::run);
    const std::int32_t table = find_table(world, "contact");
    const auto& fields = world.tables()[static_cast<std::size_t>(table)].fields;
    const auto first = static_cast<std::size_t>(find_field(fields, "block1"));
    const auto second = static_cast<std::size_t>(find_field(fields, "block2"));
    lua_newtable(L);
    lua_Integer found = 0;
    for (std::size_t row = 0; row < world.count(table); ++row) {
        const Handle contact = world.at(table, row);
        const Value one = world.get(contact, first), other = world.get(contact, second);
        if (one != Value(block) && other != Value(block)) continue;
        lua_pushlightuserdata(L, pack_handle(contact));
        lua_rawseti(L, -2, ++found);
    }
    push_runtime(L, "make_list");
    lua_insert(L, -2);
    lua_call(L, 1, 1);
    return 1;
}

struct Finder {
    std::string_view what;
    int least, most; ///< arguments
    lua_CFunction read;
    std::string_view field; ///< that the kind of object needs
};
constexpr Finder finders[] = {{"find", 1, 1, guarded<find_object>, "id"},
                              {"num", 0, 0, guarded<count_objects>, ""},
                              {"head", 0, 0, guarded<first_object>, ""},
                              {"maxid", 0, 0, guarded<greatest_id>, "id"},
                              {"isgroup", 2, 3, guarded<in_group>, "group"}};

} // namespace

void add_finders(lua_State* L) {
    const auto add = [&](const std::string& name, std::size_t table, const Finder& finder) {
        if (names_of(L).built_ins.contains(name)) return; // the model counts them itself
        lua_pushinteger(L, static_cast<lua_Integer>(table));
        lua_pushcclosure(L, finder.read, 1);
        add_reader(L, name, finder.least, finder.most);
    };
    const auto& tables = world_of(L).tables();
    for (std::size_t t = 0; t < tables.size(); ++t)
        for (const Finder& finder : finders) {
            const bool has = finder.field.empty() || find_field(tables[t].fields, finder.field) >= 0;
            if (!tables[t].modern.empty() && has) add(fmt::format("{}.{}", tables[t].modern, finder.what), t, finder);
        }
    const std::int32_t blocks = find_table(world_of(L), "block"), contacts = find_table(world_of(L), "contact");
    if (blocks < 0 || contacts < 0) return;
    if (find_field(tables[static_cast<std::size_t>(contacts)].fields, "block2") < 0) return;
    add("block.contactlist", static_cast<std::size_t>(blocks), {"", 1, 1, guarded<contacts_of>, ""});
}

} // namespace kaya::script
