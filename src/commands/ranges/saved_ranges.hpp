// Named ranges as a text that a save file can hold.
#pragma once

#include "commands/ranges/ranges.hpp"

#include <string>

namespace kaya {

/// One line for each range and for each of its elements; numbers keep all their bits.
std::string ranges_text(const NamedRanges& ranges);

/// Throws Diagnostic when the text is truncated or malformed.
NamedRanges ranges_from_text(const std::string& text);

} // namespace kaya
