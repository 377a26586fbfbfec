#include "lang/script/state/arithmetic.hpp"

#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya::script {

namespace {

struct Operation {
    const char* event; ///< name in a metatable
    const char* phrase;
};
constexpr std::array<Operation, 10> operations{{{"__add", "{} and {} cannot be added"},
                                                {"__sub", "{} and {} cannot be subtracted"},
                                                {"__mul", "{} and {} cannot be multiplied"},
                                                {"__div", "{} cannot be divided by {}"},
                                                {"__pow", "{} cannot be raised to {}"},
                                                {"__mod", "{} cannot be divided by {}"},
                                                {"__idiv", "{} cannot be divided by {}"},
                                                {"__lt", "{} and {} cannot be compared by size"},
                                                {"__le", "{} and {} cannot be compared by size"},
                                                {"__unm", "{0} has no negative"}}};

[[noreturn]] void fail_operands(lua_State* L, std::size_t operation) {
    const std::string left = describe_value(L, 1), right = describe_value(L, 2);
    throw Diagnostic(fmt::vformat(operations[operation].phrase, fmt::make_format_args(left, right)), {}, Fault::run);
}

int refuse(lua_State* L) { fail_operands(L, static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)))); }

[[noreturn]] void fail_division() { throw Diagnostic("division by zero", {}, Fault::run); }

// --- texts ----------------------------------------------------------------------------------------

/// Upvalues: number of the operation, Lua's own function.
int text_operation(lua_State* L) {
    const auto operation = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(1)));
    if (called_by_fish(L)) {
        const bool add = operation == 0;
        const auto joins = [&](int i) { return lua_type(L, i) == LUA_TSTRING || lua_type(L, i) == LUA_TNUMBER; };
        if (!add || !joins(1) || !joins(2)) fail_operands(L, operation);
        const std::string joined = text_at(L, 1) + text_at(L, 2);
        lua_pushlstring(L, joined.data(), joined.size());
        return 1;
    }
    if (lua_isnil(L, lua_upvalueindex(2))) fail_operands(L, operation);
    lua_settop(L, 2);
    lua_pushvalue(L, lua_upvalueindex(2));
    lua_insert(L, 1);
    lua_call(L, 2, 1);
    return 1;
}

// --- vectors --------------------------------------------------------------------------------------

enum class VectorOperation { add, subtract, multiply, divide };

bool is_number(lua_State* L, int index) { return lua_type(L, index) == LUA_TNUMBER; }

template <VectorOperation operation> int vector_operation(lua_State* L) {
    const bool left = is_vector(L, 1), right = is_vector(L, 2);
    constexpr auto number = static_cast<std::size_t>(operation);
    if constexpr (operation == VectorOperation::add || operation == VectorOperation::subtract) {
        if (!left || !right) fail_operands(L, number);
        const Vec3 a = vector_at(L, 1), b = vector_at(L, 2);
        push_vector(L, operation == VectorOperation::add ? Vec3(a + b) : Vec3(a - b));
    } else if constexpr (operation == VectorOperation::multiply) {
        if (left && right) push_vector(L, vector_at(L, 1).cwiseProduct(vector_at(L, 2)));
        else if (left && is_number(L, 2)) push_vector(L, vector_at(L, 1) * lua_tonumber(L, 2));
        else if (right && is_number(L, 1)) push_vector(L, vector_at(L, 2) * lua_tonumber(L, 1));
        else fail_operands(L, number);
    } else {
        if (!left || !is_number(L, 2)) fail_operands(L, number);
        if (lua_tonumber(L, 2) == 0) fail_division();
        push_vector(L, vector_at(L, 1) / lua_tonumber(L, 2));
    }
    return 1;
}

int vector_minus(lua_State* L) {
    push_vector(L, -vector_at(L, 1));
    return 1;
}

int vector_equal(lua_State* L) {
    lua_pushboolean(L, is_vector(L, 1) && is_vector(L, 2) && vector_at(L, 1) == vector_at(L, 2));
    return 1;
}

int vector_show(lua_State* L) {
    const std::string text = text_at(L, 1);
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

int vector_length(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, "length").norm());
    return 1;
}

int vector_unit(lua_State* L) {
    const Vec3 v = vector_argument(L, 1, "unit");
    const double length = v.norm();
    if (length == 0) throw Diagnostic("a vector of length zero has no direction", {}, Fault::run);
    push_vector(L, v / length);
    return 1;
}

int vector_dot(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, "dot").dot(vector_argument(L, 2, "dot")));
    return 1;
}

int vector_cross(lua_State* L) {
    push_vector(L, vector_argument(L, 1, "cross").cross(vector_argument(L, 2, "cross")));
    return 1;
}

/// Upvalue: the table of methods.
int vector_index(lua_State* L) {
    std::size_t size = 0;
    const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tolstring(L, 2, &size) : nullptr;
    if (key && size == 1 && *key >= 'x' && *key <= 'z') {
        lua_pushnumber(L, vector_at(L, 1)[*key - 'x']);
        return 1;
    }
    lua_pushvalue(L, 2);
    lua_rawget(L, lua_upvalueindex(1));
    if (lua_isnil(L, -1))
        throw Diagnostic(key ? fmt::format("a vector has no '{}'", key)
                             : fmt::format("a vector has no element for {}", describe_value(L, 2)),
                         "it has x, y, z, and the functions length(), unit(), dot(v), cross(v)", Fault::run);
    return 1;
}

int vector_new_index(lua_State*) {
    throw Diagnostic("the components of a vector cannot be set one by one", "make a new one: v = vector(1, v.y, v.z)",
                     Fault::run);
}

// --- numbers of FISH ------------------------------------------------------------------------------

int divide(lua_State* L) {
    if (lua_isinteger(L, 1) && lua_isinteger(L, 2)) {
        const lua_Integer a = lua_tointeger(L, 1), b = lua_tointeger(L, 2);
        if (b == 0) fail_division();
        // The one quotient that does not fit: Lua's own minus wraps around in the same way.
        lua_pushinteger(L, b == -1 ? static_cast<lua_Integer>(0u - static_cast<lua_Unsigned>(a)) : a / b);
        return 1;
    }
    if (is_number(L, 2) && lua_tonumber(L, 2) == 0) fail_division();
    if (is_number(L, 1) && is_number(L, 2)) {
        lua_pushnumber(L, lua_tonumber(L, 1) / lua_tonumber(L, 2));
        return 1;
    }
    if (!is_vector(L, 1)) fail_operands(L, 3);
    return vector_operation<VectorOperation::divide>(L);
}

/// a / b of the modern dialect: always a number with a point.
int ratio(lua_State* L) {
    if (!is_number(L, 1) || !is_number(L, 2)) {
        if (is_vector(L, 1)) return vector_operation<VectorOperation::divide>(L);
        const int table = lua_istable(L, 1) ? 1 : 2;
        if (!lua_istable(L, table) || !luaL_getmetafield(L, table, "__div")) fail_operands(L, 3);
        lua_insert(L, 1);
        lua_call(L, 2, 1);
        return 1;
    }
    if (lua_tonumber(L, 2) == 0) fail_division();
    lua_pushnumber(L, lua_tonumber(L, 1) / lua_tonumber(L, 2));
    return 1;
}

/// a // b and a % b round down.
template <int operation> int whole_division(lua_State* L) {
    if (!is_number(L, 1) || !is_number(L, 2)) fail_operands(L, 3);
    if (lua_tonumber(L, 2) == 0) fail_division();
    lua_settop(L, 2);
    lua_arith(L, operation);
    return 1;
}

/// Exact as long as it fits into 64 bits.
bool whole_power(lua_Integer base, lua_Integer exponent, lua_Integer& result) {
    result = 1;
    for (; exponent > 0; exponent /= 2) {
        if (exponent % 2 == 1 && __builtin_mul_overflow(result, base, &result)) return false;
        if (exponent > 1 && __builtin_mul_overflow(base, base, &base)) return false;
    }
    return true;
}

int power(lua_State* L) {
    if (!is_number(L, 1) || !is_number(L, 2)) fail_operands(L, 4);
    if (lua_isinteger(L, 1) && lua_isinteger(L, 2) && lua_tointeger(L, 2) >= 0) {
        lua_Integer result = 0;
        if (whole_power(lua_tointeger(L, 1), lua_tointeger(L, 2), result)) {
            lua_pushinteger(L, result);
            return 1;
        }
    }
    const double base = lua_tonumber(L, 1), exponent = lua_tonumber(L, 2);
    if (base == 0 && exponent < 0) fail_division();
    if (base < 0 && exponent != std::floor(exponent))
        throw Diagnostic(fmt::format("the negative number {:g} has no power {:g}", base, exponent), {}, Fault::run);
    lua_pushnumber(L, exponent == 2 ? base * base : std::pow(base, exponent)); // as Lua does it
    return 1;
}

int step(lua_State* L) {
    if (!is_number(L, 1) || lua_tonumber(L, 1) == 0)
        throw Diagnostic(fmt::format("the step of a loop is {}", describe_value(L, 1)),
                         "it must be a number other than 0", Fault::run);
    lua_settop(L, 1);
    return 1;
}

/// The whole number that a value is, or nil.
int whole(lua_State* L) {
    int is_whole = 0;
    const lua_Integer number = is_number(L, 1) ? lua_tointegerx(L, 1, &is_whole) : 0;
    if (is_whole) lua_pushinteger(L, number);
    else lua_pushnil(L);
    return 1;
}

constexpr std::array<luaL_Reg, 5> vector_methods{{{"length", guarded<vector_length>},
                                                  {"unit", guarded<vector_unit>},
                                                  {"dot", guarded<vector_dot>},
                                                  {"cross", guarded<vector_cross>},
                                                  {nullptr, nullptr}}};

constexpr std::array<luaL_Reg, 9> vector_events{{{"__add", guarded<vector_operation<VectorOperation::add>>},
                                                 {"__sub", guarded<vector_operation<VectorOperation::subtract>>},
                                                 {"__mul", guarded<vector_operation<VectorOperation::multiply>>},
                                                 {"__div", guarded<vector_operation<VectorOperation::divide>>},
                                                 {"__unm", guarded<vector_minus>},
                                                 {"__eq", guarded<vector_equal>},
                                                 {"__tostring", guarded<vector_show>},
                                                 {"__newindex", guarded<vector_new_index>},
                                                 {nullptr, nullptr}}};

constexpr std::array<luaL_Reg, 8> runtime_functions{{{"divide", guarded<divide>},
                                                     {"ratio", guarded<ratio>},
                                                     {"floor_divide", guarded<whole_division<LUA_OPIDIV>>},
                                                     {"remainder", guarded<whole_division<LUA_OPMOD>>},
                                                     {"power", guarded<power>},
                                                     {"step", guarded<step>},
                                                     {"whole", guarded<whole>},
                                                     {nullptr, nullptr}}};

} // namespace

void add_refusing_arithmetic(lua_State* L) {
    for (std::size_t i = 0; i < operations.size(); ++i) {
        lua_pushinteger(L, static_cast<lua_Integer>(i));
        lua_pushcclosure(L, guarded<refuse>, 1);
        lua_setfield(L, -2, operations[i].event);
    }
}

void open_text_arithmetic(lua_State* L) {
    lua_pushstring(L, "");
    if (!lua_getmetatable(L, -1)) {
        lua_pop(L, 1);
        return;
    }
    for (std::size_t i = 0; i < operations.size(); ++i) {
        lua_pushinteger(L, static_cast<lua_Integer>(i));
        lua_getfield(L, -2, operations[i].event);
        lua_pushcclosure(L, guarded<text_operation>, 2);
        lua_setfield(L, -2, operations[i].event);
    }
    lua_pushboolean(L, 0); // getmetatable("") returns this: a chunk must not change the arithmetic of FISH
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 2);
}

void open_vectors(lua_State* L) {
    lua_newtable(L);
    add_refusing_arithmetic(L);
    luaL_setfuncs(L, vector_events.data(), 0);
    lua_newtable(L);
    luaL_setfuncs(L, vector_methods.data(), 0);
    lua_pushcclosure(L, guarded<vector_index>, 1);
    lua_setfield(L, -2, "__index");
    lua_pushstring(L, "vector");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    state_of(L).vector_address = lua_topointer(L, -1);
    state_of(L).vector_type = luaL_ref(L, LUA_REGISTRYINDEX);
}

void add_runtime_arithmetic(lua_State* L) { luaL_setfuncs(L, runtime_functions.data(), 0); }

} // namespace kaya::script
