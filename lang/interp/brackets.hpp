// Pairs of brackets.
#pragma once

#include <cstddef>
#include <string_view>

namespace kaya::lang {

/// One past the bracket that closes the one at `open`, or npos. Quotes inside are skipped.
std::size_t past_closing(std::string_view line, std::size_t open, char opening, char closing);

/// Follows the brackets of one of several lines; `depth` are open at its start. One past the bracket that closes the last of them, or npos.
/// Quotes end with their line, and a comment ends the line.
std::size_t past_last_closing(std::string_view line, std::size_t from, int& depth);

} // namespace kaya::lang
