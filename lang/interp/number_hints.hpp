// Numbers that people write and decks do not take: with a unit, or to be worked out.
#pragma once

#include <string>
#include <string_view>

namespace kaya::lang {

/// What to write in place of a word where a number must be: "1GPa", "-9.81*2". Empty when it looks like neither.
std::string number_hint(std::string_view text);

/// The same for a unit after a number, as in 1 GPa; empty when the word is none.
std::string unit_hint(double number, std::string_view word);

} // namespace kaya::lang
