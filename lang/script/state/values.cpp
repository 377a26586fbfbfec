#include "lang/script/state/values.hpp"

#include "lang/script/state/compounds.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/values/handles.hpp"
#include "lang/script/values/value_text.hpp"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <new>

namespace kaya::script {

void push_lua_value(lua_State* L, const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return lua_pushnumber(L, *number); // nearly always
    switch (value.index()) {
    case 0: lua_pushnil(L); break;
    case 1: lua_pushboolean(L, *std::get_if<bool>(&value)); break;
    case 2: lua_pushinteger(L, *std::get_if<std::int64_t>(&value)); break;
    case 4: {
        const auto& text = *std::get_if<std::string>(&value);
        lua_pushlstring(L, text.data(), text.size());
        break;
    }
    case 5: push_vector(L, *std::get_if<Vec3>(&value)); break;
    case 7: push_compound(L, **std::get_if<std::shared_ptr<const Compound>>(&value)); break;
    default: {
        const Handle& handle = *std::get_if<Handle>(&value);
        if (handle.generation == 0) lua_pushnil(L);
        else lua_pushlightuserdata(L, pack_handle(handle));
    }
    }
}

void push_fish_value(lua_State* L, const Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return lua_pushnumber(L, *number); // nearly always
    push_lua_value(L, value);
    make_fish_value(L);
}

void make_fish_value(lua_State* L) {
    const int type = lua_type(L, -1);
    if (type != LUA_TNIL && type != LUA_TBOOLEAN) return;
    const int number = lua_toboolean(L, -1);
    lua_pop(L, 1);
    lua_pushinteger(L, number);
}

Value value_at(lua_State* L, int index, const std::string& what) {
    switch (lua_type(L, index)) {
    case LUA_TNONE:
    case LUA_TNIL: return std::monostate{};
    case LUA_TBOOLEAN: return lua_toboolean(L, index) != 0;
    case LUA_TNUMBER:
        if (lua_isinteger(L, index)) return static_cast<std::int64_t>(lua_tointeger(L, index));
        return static_cast<double>(lua_tonumber(L, index));
    case LUA_TSTRING: {
        std::size_t size = 0;
        const char* text = lua_tolstring(L, index, &size);
        return std::string(text, size);
    }
    case LUA_TLIGHTUSERDATA: return unpack_handle(lua_touserdata(L, index));
    default: break;
    }
    if (is_vector(L, index)) return vector_at(L, index);
    if (const std::string kind = kind_of_value(L, index); !kind.empty()) return compound_at(L, index, kind);
    throw Diagnostic(fmt::format("{} is {}, where one value is needed", what, describe_value(L, index)),
                     "a value is a number, a text, a vector or a pointer", Fault::run);
}

std::string describe_value(lua_State* L, int index) {
    switch (lua_type(L, index)) {
    case LUA_TNONE:
    case LUA_TNIL: return "nothing";
    case LUA_TBOOLEAN: return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER:
        return fmt::format("the {} {}", lua_isinteger(L, index) ? "integer" : "number", text_at(L, index));
    case LUA_TSTRING: return fmt::format("the text '{}'", lua_tostring(L, index));
    case LUA_TLIGHTUSERDATA: return "a pointer to " + handle_text(world_of(L), unpack_handle(lua_touserdata(L, index)));
    case LUA_TFUNCTION: return "a function";
    case LUA_TTABLE: {
        const std::string kind = kind_of_value(L, index);
        return is_array(L, index) ? "an array" : kind.empty() ? "a table" : "a " + kind;
    }
    default: break;
    }
    if (is_vector(L, index)) return "the vector " + text_at(L, index);
    return fmt::format("a {}", luaL_typename(L, index));
}

std::string text_at(lua_State* L, int index) {
    const int type = lua_type(L, index);
    if (!kind_of_value(L, index).empty()) return text_of_value(L, index);
    const bool plain = type != LUA_TTABLE && type != LUA_TFUNCTION && (type != LUA_TUSERDATA || is_vector(L, index));
    if (!plain) return describe_value(L, index);
    return to_text(value_at(L, index, "this"), &world_of(L));
}

bool is_vector(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return false;
    const bool same = lua_topointer(L, -1) == state_of(L).vector_address;
    lua_pop(L, 1);
    return same;
}

void push_vector(lua_State* L, const Vec3& vector) {
    static_assert(std::is_trivially_destructible_v<Vec3>, "vectors need no __gc");
    new (lua_newuserdatauv(L, sizeof(Vec3), 0)) Vec3(vector);
    push_anchor(L, state_of(L).vector_type);
    lua_setmetatable(L, -2);
}

const Vec3& vector_at(lua_State* L, int index) { return *static_cast<const Vec3*>(lua_touserdata(L, index)); }

bool called_by_fish(lua_State* L) {
    lua_Debug record;
    if (!lua_getstack(L, 1, &record)) return false;
    lua_getinfo(L, "S", &record);
    return std::strncmp(record.source, "=fish#", 6) == 0;
}

void fail_argument(lua_State* L, int index, const char* function, const char* wanted) {
    const int count = lua_gettop(L);
    const std::string position = index == 1 && count <= 1 ? "" : fmt::format("argument {} of ", index);
    throw Diagnostic(fmt::format("{}'{}' must be {}, here it is {}", position.empty() ? "the argument of " : position,
                                 function, wanted, describe_value(L, index)),
                     {}, Fault::run);
}

double number_argument(lua_State* L, int index, const char* function) {
    if (lua_type(L, index) != LUA_TNUMBER) fail_argument(L, index, function, "a number");
    return lua_tonumber(L, index);
}

std::int64_t integer_argument(lua_State* L, int index, const char* function) {
    int whole = 0;
    const lua_Integer number = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &whole) : 0;
    if (!whole) fail_argument(L, index, function, "a whole number");
    return number;
}

std::string text_argument(lua_State* L, int index, const char* function) {
    if (lua_type(L, index) != LUA_TSTRING) fail_argument(L, index, function, "a text");
    std::size_t size = 0;
    const char* text = lua_tolstring(L, index, &size);
    return {text, size};
}

Vec3 vector_argument(lua_State* L, int index, const char* function) {
    if (!is_vector(L, index)) fail_argument(L, index, function, "a vector");
    return vector_at(L, index);
}

} // namespace kaya::script
