// Lines of other programs and languages: a file of theirs gets one message that says what it is.
#pragma once

#include "lang/interp/lexer.hpp"

#include <optional>

namespace kaya::lang {

/// What to say of a statement that is none of kaya's and looks like one of another program.
std::optional<Diagnostic> other_language(const Statement& statement);

} // namespace kaya::lang
