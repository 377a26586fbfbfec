// Lines of other programs and languages: a file of theirs gets one message that says what it is.
#pragma once

#include "lang/interp/lexer.hpp"

#include <optional>
#include <string_view>

namespace kaya::lang {

/// What to say of a statement that is none of kaya's and looks like one of another program.
std::optional<Diagnostic> other_language(const Statement& statement);

/// Advice for a line that begins with no command: a prompt, a comment of another language, a variable. Empty for others.
std::string_view odd_line_hint(const Statement& statement);

} // namespace kaya::lang
