// The value of an @name or an [expression] in a command.
#pragma once

#include "base/diagnostic.hpp"
#include "base/vector.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <variant>

namespace kaya::lang {

/// nil (a name that was never set), truth, integer, real, text, vector.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Vec3>;

/// Returns the value of an expression of the script language: the text after @ or between [ and ], e.g. "pressure", "f(1,2)", "2*r". The
/// place is that of the word in the deck. Throws Diagnostic.
using ValueSource = std::function<Value(const std::string& expression, const Place& place)>;

} // namespace kaya::lang
