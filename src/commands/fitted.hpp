// Messages on a narrow terminal: lines are broken between words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kaya {

/// Lines of a message broken at blanks so that they fit into `columns`, and indented where they go on. Lines of the deck,
/// "  12 | poly brick", stay as they are. Colours take no place.
std::string fitted(std::string_view text, std::size_t columns);

} // namespace kaya
