#include "lang/script/state/compounds.hpp"

#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <memory>
#include <new>

namespace kaya::script {

std::string kind_of_value(lua_State* L, int index) {
    if (!lua_istable(L, index)) return {};
    const int place = lua_absindex(L, index);
    push_runtime(L, "kind_of");
    lua_pushvalue(L, place);
    const bool done = lua_pcall(L, 1, 1, 0) == LUA_OK;
    std::string kind = done && lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "";
    lua_pop(L, 1);
    return kind == "array" ? std::string() : kind;
}

namespace {
constexpr int deepest = 20;      ///< levels of lists in lists that the program takes over
constexpr int room_of_level = 6; ///< of Lua's stack

/// The numbered elements of the table at the top of the stack.
void take_elements(lua_State* L, std::vector<Value>& to) {
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, -1)); ++i) {
        lua_rawgeti(L, -1, i);
        to.push_back(value_at(L, -1, "an element"));
        lua_pop(L, 1);
    }
}
} // namespace

Value compound_at(lua_State* L, int index, const std::string& kind) {
    auto made = std::make_shared<Compound>();
    made->kind = kind;
    made->text = text_of_value(L, index);
    if (lua_gettop(L) > deepest * room_of_level) return made; // its text must do
    if (!lua_checkstack(L, room_of_level)) throw std::bad_alloc();
    const int place = lua_absindex(L, index);
    if (kind == "map") {
        push_runtime(L, "keys_of");
        lua_pushvalue(L, place);
        call_protected(L, 1, 1);
        take_elements(L, made->keys);
        for (lua_Integer i = 1; i <= static_cast<lua_Integer>(made->keys.size()); ++i) {
            lua_rawgeti(L, -1, i);
            lua_rawget(L, place);
            made->members.push_back(value_at(L, -1, "a value of the map"));
            lua_pop(L, 1);
        }
    } else {
        if (kind == "matrix") {
            lua_getfield(L, place, "columns");
            made->keys.emplace_back(static_cast<std::int64_t>(lua_tointeger(L, -1)));
            lua_pop(L, 1);
        }
        if (kind == "structure") lua_getfield(L, place, "values");
        else lua_pushvalue(L, place);
        take_elements(L, made->members);
    }
    lua_pop(L, 1);
    return made;
}

void push_compound(lua_State* L, const Compound& compound) {
    if (!lua_checkstack(L, room_of_level)) throw std::bad_alloc();
    lua_newtable(L);
    for (std::size_t i = 0; i < compound.members.size(); ++i) {
        if (compound.kind == "map") push_fish_value(L, compound.keys[i]);
        else lua_pushinteger(L, static_cast<lua_Integer>(i) + 1);
        push_fish_value(L, compound.members[i]);
        lua_rawset(L, -3);
    }
    if (compound.kind == "matrix") {
        push_fish_value(L, compound.keys.front());
        lua_setfield(L, -2, "columns");
    }
    push_runtime(L, "types");
    lua_getfield(L, -1, compound.kind == "structure" ? "list" : compound.kind.c_str()); // its kind may be unknown here
    lua_setmetatable(L, -3);
    lua_pop(L, 1);
}

std::string text_of_value(lua_State* L, int index) {
    const int place = lua_absindex(L, index);
    push_runtime(L, "text");
    lua_pushvalue(L, place);
    const bool done = lua_pcall(L, 1, 1, 0) == LUA_OK; // too many lists in lists
    std::string text = done ? lua_tostring(L, -1) : "...";
    lua_pop(L, 1);
    return text;
}

} // namespace kaya::script
