// Built-in functions of FISH on numbers and vectors.
#include "lang/script/base/random.hpp"
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/values.hpp"

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace kaya::script {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degrees = pi / 180;

int sine(lua_State* L) {
    lua_pushnumber(L, std::sin(number_argument(L, 1, "sin")));
    return 1;
}

int cosine(lua_State* L) {
    lua_pushnumber(L, std::cos(number_argument(L, 1, "cos")));
    return 1;
}

int tangent(lua_State* L) {
    lua_pushnumber(L, std::tan(number_argument(L, 1, "tan")));
    return 1;
}

int arc_tangent(lua_State* L) {
    lua_pushnumber(L, std::atan(number_argument(L, 1, "atan")));
    return 1;
}

int exponential(lua_State* L) {
    lua_pushnumber(L, std::exp(number_argument(L, 1, "exp")));
    return 1;
}

[[noreturn]] void fail_domain(const char* name, double x, const char* limits) {
    throw Diagnostic(fmt::format("'{}' is given {:g}; it takes {}", name, x, limits), {}, Fault::run);
}

int square_root(lua_State* L) {
    const double x = number_argument(L, 1, "sqrt");
    if (x < 0) fail_domain("sqrt", x, "no negative number");
    lua_pushnumber(L, std::sqrt(x));
    return 1;
}

int natural_logarithm(lua_State* L) {
    const double x = number_argument(L, 1, "ln");
    if (!(x > 0)) fail_domain("ln", x, "numbers above 0");
    lua_pushnumber(L, std::log(x));
    return 1;
}

int decimal_logarithm(lua_State* L) {
    const double x = number_argument(L, 1, "log");
    if (!(x > 0)) fail_domain("log", x, "numbers above 0");
    lua_pushnumber(L, std::log10(x));
    return 1;
}

int arc_sine(lua_State* L) {
    const double x = number_argument(L, 1, "asin");
    if (std::abs(x) > 1) fail_domain("asin", x, "numbers from -1 to 1");
    lua_pushnumber(L, std::asin(x));
    return 1;
}

int arc_cosine(lua_State* L) {
    const double x = number_argument(L, 1, "acos");
    if (std::abs(x) > 1) fail_domain("acos", x, "numbers from -1 to 1");
    lua_pushnumber(L, std::acos(x));
    return 1;
}

int arc_tangent_of_two(lua_State* L) {
    lua_pushnumber(L, std::atan2(number_argument(L, 1, "atan2"), number_argument(L, 2, "atan2")));
    return 1;
}

int absolute(lua_State* L) {
    const double x = number_argument(L, 1, "abs");
    if (lua_isinteger(L, 1)) lua_pushinteger(L, std::abs(lua_tointeger(L, 1)));
    else lua_pushnumber(L, std::abs(x));
    return 1;
}

int sign(lua_State* L) {
    const double x = number_argument(L, 1, "sgn");
    const bool negative = x < 0;
    if (lua_isinteger(L, 1)) lua_pushinteger(L, negative ? -1 : 1);
    else lua_pushnumber(L, negative ? -1.0 : 1.0);
    return 1;
}

void push_whole(lua_State* L, double x, const char* name) {
    if (!(std::abs(x) < 0x1p63)) fail_domain(name, x, "numbers that an integer can hold");
    lua_pushinteger(L, static_cast<lua_Integer>(x));
}

int rounded(lua_State* L) {
    push_whole(L, std::round(number_argument(L, 1, "round")), "round");
    return 1;
}

/// max(a, b, ...): the result is whole only when all arguments are.
template <bool greatest> int extreme(lua_State* L) {
    const char* name = greatest ? "max" : "min";
    int best = 1;
    bool whole = true;
    for (int i = 1; i <= lua_gettop(L); ++i) {
        number_argument(L, i, name);
        whole = whole && lua_isinteger(L, i);
        if (lua_compare(L, greatest ? best : i, greatest ? i : best, LUA_OPLT)) best = i;
    }
    if (whole) lua_pushvalue(L, best);
    else lua_pushnumber(L, lua_tonumber(L, best));
    return 1;
}

int push_pi(lua_State* L) {
    lua_pushnumber(L, pi);
    return 1;
}

int push_degree(lua_State* L) {
    lua_pushnumber(L, degrees);
    return 1;
}

int uniform(lua_State* L) {
    lua_pushnumber(L, fish_of(L).random.uniform());
    return 1;
}

int gaussian(lua_State* L) {
    lua_pushnumber(L, fish_of(L).random.gaussian());
    return 1;
}

int bits_and(lua_State* L) {
    lua_pushinteger(L, integer_argument(L, 1, "and") & integer_argument(L, 2, "and"));
    return 1;
}

int bits_or(lua_State* L) {
    lua_pushinteger(L, integer_argument(L, 1, "or") | integer_argument(L, 2, "or"));
    return 1;
}

int bits_not(lua_State* L) {
    lua_pushinteger(L, ~integer_argument(L, 1, "not"));
    return 1;
}

/// Bits shifted beyond the 64 of an integer are lost; a negative count shifts in the other direction.
void push_shifted(lua_State* L, std::int64_t value, std::int64_t left) {
    const auto bits = static_cast<std::uint64_t>(value);
    if (left <= -64 || left >= 64) lua_pushinteger(L, 0);
    else lua_pushinteger(L, static_cast<lua_Integer>(left >= 0 ? bits << left : bits >> -left));
}

int shift_left(lua_State* L) {
    push_shifted(L, integer_argument(L, 1, "lshift"), integer_argument(L, 2, "lshift"));
    return 1;
}

int shift_right(lua_State* L) {
    push_shifted(L, integer_argument(L, 1, "rshift"), -integer_argument(L, 2, "rshift"));
    return 1;
}

// --- vectors ----------------------------------------------------------------------------------------

int make_vector(lua_State* L) {
    Vec3 v = Vec3::Zero();
    for (int i = 0; i < lua_gettop(L); ++i) v[i] = number_argument(L, i + 1, "vector");
    push_vector(L, v);
    return 1;
}

constexpr std::array<const char*, 3> component_names{"xcomp", "ycomp", "zcomp"};

template <int axis> int component(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, component_names[axis])[axis]);
    return 1;
}

template <int axis> int with_component(lua_State* L) {
    Vec3 v = vector_argument(L, 1, component_names[axis]);
    v[axis] = number_argument(L, 2, component_names[axis]);
    push_vector(L, v);
    return 1;
}

int dot(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, "dot").dot(vector_argument(L, 2, "dot")));
    return 1;
}

int cross(lua_State* L) {
    push_vector(L, vector_argument(L, 1, "cross").cross(vector_argument(L, 2, "cross")));
    return 1;
}

int magnitude(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, "mag").norm());
    return 1;
}

int squared_magnitude(lua_State* L) {
    lua_pushnumber(L, vector_argument(L, 1, "mag2").squaredNorm());
    return 1;
}

int unit(lua_State* L) {
    const Vec3 v = vector_argument(L, 1, "unit");
    if (v.norm() == 0) throw Diagnostic("'unit' is given a vector of length zero", {}, Fault::run);
    push_vector(L, v / v.norm());
    return 1;
}

// --- orientation of planes: dip from the horizontal, dip direction clockwise from y, both in degrees ------

/// The upward normal of a vector that may point down.
Vec3 upward(const Vec3& normal) { return normal[2] < 0 ? Vec3(-normal) : normal; }

int dip(lua_State* L) {
    const Vec3 n = upward(vector_argument(L, 1, "dipfromnorm"));
    lua_pushnumber(L, std::atan2(std::hypot(n[0], n[1]), n[2]) / degrees);
    return 1;
}

int dip_direction(lua_State* L) {
    const Vec3 n = upward(vector_argument(L, 1, "ddfromnorm"));
    const double angle = std::atan2(n[0], n[1]) / degrees;
    lua_pushnumber(L, angle < 0 ? angle + 360 : angle);
    return 1;
}

int normal(lua_State* L) {
    const double inclination = number_argument(L, 1, "normfromdipdd") * degrees;
    const double direction = number_argument(L, 2, "normfromdipdd") * degrees;
    push_vector(L, {std::sin(inclination) * std::sin(direction), std::sin(inclination) * std::cos(direction),
                    std::cos(inclination)});
    return 1;
}

/// Hundredths of a second; only differences mean something.
int clock(lua_State* L) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    lua_pushinteger(L, std::chrono::duration_cast<std::chrono::milliseconds>(now).count() / 10);
    return 1;
}

constexpr std::array mathematical_functions{
    BuiltInFunction{"abs", 1, 1, guarded<absolute>},
    BuiltInFunction{"acos", 1, 1, guarded<arc_cosine>},
    BuiltInFunction{"asin", 1, 1, guarded<arc_sine>},
    BuiltInFunction{"atan", 1, 1, guarded<arc_tangent>},
    BuiltInFunction{"atan2", 2, 2, guarded<arc_tangent_of_two>},
    BuiltInFunction{"cos", 1, 1, guarded<cosine>},
    BuiltInFunction{"sin", 1, 1, guarded<sine>},
    BuiltInFunction{"tan", 1, 1, guarded<tangent>},
    BuiltInFunction{"exp", 1, 1, guarded<exponential>},
    BuiltInFunction{"ln", 1, 1, guarded<natural_logarithm>},
    BuiltInFunction{"log", 1, 1, guarded<decimal_logarithm>},
    BuiltInFunction{"sqrt", 1, 1, guarded<square_root>},
    BuiltInFunction{"sgn", 1, 1, guarded<sign>},
    BuiltInFunction{"round", 1, 1, guarded<rounded>},
    BuiltInFunction{"max", 1, 20, guarded<extreme<true>>},
    BuiltInFunction{"min", 1, 20, guarded<extreme<false>>},
    BuiltInFunction{"pi", 0, 0, guarded<push_pi>},
    BuiltInFunction{"degrad", 0, 0, guarded<push_degree>},
    BuiltInFunction{"urand", 0, 0, guarded<uniform>},
    BuiltInFunction{"grand", 0, 0, guarded<gaussian>},
    BuiltInFunction{"and", 2, 2, guarded<bits_and>},
    BuiltInFunction{"or", 2, 2, guarded<bits_or>},
    BuiltInFunction{"not", 1, 1, guarded<bits_not>},
    BuiltInFunction{"lshift", 2, 2, guarded<shift_left>},
    BuiltInFunction{"rshift", 2, 2, guarded<shift_right>},
    BuiltInFunction{"vector", 0, 3, guarded<make_vector>},
    BuiltInFunction{"xcomp", 1, 1, guarded<component<0>>, guarded<with_component<0>>},
    BuiltInFunction{"ycomp", 1, 1, guarded<component<1>>, guarded<with_component<1>>},
    BuiltInFunction{"zcomp", 1, 1, guarded<component<2>>, guarded<with_component<2>>},
    BuiltInFunction{"dot", 2, 2, guarded<dot>},
    BuiltInFunction{"cross", 2, 2, guarded<cross>},
    BuiltInFunction{"mag", 1, 1, guarded<magnitude>},
    BuiltInFunction{"mag2", 1, 1, guarded<squared_magnitude>},
    BuiltInFunction{"unit", 1, 1, guarded<unit>},
    BuiltInFunction{"dipfromnorm", 1, 1, guarded<dip>},
    BuiltInFunction{"ddfromnorm", 1, 1, guarded<dip_direction>},
    BuiltInFunction{"normfromdipdd", 2, 2, guarded<normal>},
    BuiltInFunction{"clock", 0, 0, guarded<clock>},
};

} // namespace

void add_mathematics(lua_State* L) { add_built_ins(L, mathematical_functions); }

} // namespace kaya::script
