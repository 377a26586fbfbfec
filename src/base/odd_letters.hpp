// Letters that look like others: replacements made by word processors.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// "there is the letter U+201C in it: write the plain \"" for the first letter of a text that has a plain one in its place;
/// empty when there is none.
std::string odd_letter_hint(std::string_view text);

/// The same for a word of a command, where Greek and Cyrillic letters that look like Latin ones are odd, too.
std::string odd_word_hint(std::string_view text);

/// The same for a text that was meant as a number, where all letters beyond ASCII are odd.
std::string odd_digit_hint(std::string_view text);

} // namespace kaya
