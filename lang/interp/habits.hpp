// Words that users of other programs, and of other commands, write by habit.
#pragma once

#include <string_view>

namespace kaya::lang {

/// What to write in place of a word, in lower case, that `place` does not have ("a command", "a keyword of jset"); empty when the word has
/// none.
std::string_view habit_hint(std::string_view place, std::string_view word);

} // namespace kaya::lang
