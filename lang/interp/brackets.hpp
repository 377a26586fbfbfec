// Pairs of brackets in one line.
#pragma once

#include <cstddef>
#include <string_view>

namespace kaya::lang {

/// One past the bracket that closes the one at `open`, or npos. Quotes inside are skipped.
std::size_t past_closing(std::string_view line, std::size_t open, char opening, char closing);

} // namespace kaya::lang
