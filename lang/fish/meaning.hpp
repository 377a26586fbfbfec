// Meanings of names that a function does not define.
#pragma once

#include "base/diagnostic.hpp"

#include <array>
#include <functional>
#include <string>
#include <string_view>

namespace kaya::fish {

/// Meaning of a name that is neither local nor an argument.
enum class NameKind {
    variable, ///< a global variable, or something that does not exist yet
    function, ///< a FISH function, or a function written in Lua
    built_in, ///< sin, cx_nforce, b_near, time, ...
};

struct Meaning {
    NameKind kind = NameKind::variable;
    int least = 0; ///< number of arguments
    int most = 0;
    bool writable = false;  ///< a built-in that may stand left of `=`
    bool exists = false;    ///< a variable that has a value
    std::string whole = {}; ///< of a built-in that the name shortens: block.gp.disp for block.gp.di
};

/// Throws Diagnostic when a function, or a built-in name, is called with a wrong number of arguments.
void check_arguments(const std::string& name, int given, const Meaning& meaning, const Place& place);

/// The names of values, with what they are in Lua.
struct ClassicConstant {
    std::string_view name, lua;
};
inline constexpr std::array<ClassicConstant, 5> classic_constants{
    {{"true", "1"}, {"false", "0"}, {"on", "1"}, {"off", "0"}, {"null", "0"}}};

/// True for the names of values: true, false, on, off, null.
bool is_constant(std::string_view name);

/// True for list, map, tensor, boolean: they make values in the modern dialect and are names of variables in the classic one.
bool makes_value(std::string_view name);

/// Returns the present meaning of a name (in lower case) to the code generator.
using Dictionary = std::function<Meaning(std::string_view name)>;

} // namespace kaya::fish
