// Letters that look like others: replacements made by word processors.
#pragma once

#include <string>
#include <string_view>

namespace kaya::lang {

/// "'“' is U+201C: write \"" for the first such letter of a text; empty when there is none.
std::string odd_letter_hint(std::string_view text);

} // namespace kaya::lang
