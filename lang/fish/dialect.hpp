// The two kinds of FISH.
#pragma once

#include <cstdint>

namespace kaya::fish {

/// Classic: `def`, `@name`. Modern: functions that begin with the word `fish`, expressions in brackets.
/// In the modern dialect whole numbers divided give a number with a point, the own name of a function in an expression calls it, lists, maps
/// and structures are values, and `list`, `map`, `tensor` make them.
enum class Dialect : std::uint8_t { classic, modern };

} // namespace kaya::fish
