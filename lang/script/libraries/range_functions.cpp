// Built-in functions of FISH on places and named ranges: find_range, in_range, inbox.
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/handles.hpp"

#include <array>

namespace kaya::script {

namespace {

/// find_range(name): returns the name, or 0 when there is no such range.
int find_range(lua_State* L) {
    const std::string name = text_argument(L, 1, "find_range");
    if (world_of(L).has_range(name)) lua_pushlstring(L, name.data(), name.size());
    else lua_pushinteger(L, 0);
    return 1;
}

/// in_range(name, object or place)
int in_range(lua_State* L) {
    const std::string name = text_argument(L, 1, "in_range");
    World& world = world_of(L);
    bool inside = false;
    if (is_vector(L, 2)) inside = world.in_range(name, vector_at(L, 2));
    else if (lua_type(L, 2) == LUA_TLIGHTUSERDATA) inside = world.in_range(name, unpack_handle(lua_touserdata(L, 2)));
    else fail_argument(L, 2, "in_range", "a pointer to an object or a vector");
    lua_pushinteger(L, inside ? 1 : 0);
    return 1;
}

/// inbox(corner, opposite corner, place)
int inbox(lua_State* L) {
    const Vec3 one = vector_argument(L, 1, "inbox"), other = vector_argument(L, 2, "inbox");
    const Vec3 place = vector_argument(L, 3, "inbox");
    const bool inside =
        (place.array() >= one.cwiseMin(other).array()).all() && (place.array() <= one.cwiseMax(other).array()).all();
    lua_pushinteger(L, inside ? 1 : 0);
    return 1;
}

constexpr std::array range_functions{
    BuiltInFunction{"find_range", 1, 1, guarded<find_range>},
    BuiltInFunction{"in_range", 2, 2, guarded<in_range>},
    BuiltInFunction{"inbox", 3, 3, guarded<inbox>},
};

} // namespace

void add_ranges(lua_State* L) { add_built_ins(L, range_functions); }

} // namespace kaya::script
