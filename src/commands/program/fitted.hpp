// Messages on a narrow terminal: lines are broken between words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kaya {

/// Breaks the lines of a message at blanks to fit into `columns`, and indents continuations. Lines of the deck, "  12 | poly brick", are
/// unchanged. Colour codes have no width.
std::string fitted(std::string_view text, std::size_t columns);

} // namespace kaya
