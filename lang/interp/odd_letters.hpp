// Letters that look like others: what a word processor puts in place of what was typed.
#pragma once

#include <string>
#include <string_view>

namespace kaya::lang {

/// "'“' is U+201C: write \"" for the first such letter of a text; empty when there is none.
std::string odd_letter_hint(std::string_view text);

} // namespace kaya::lang
