// Commands of 3DEC 6 and later: `model new`, `block create brick`. They are another dialect, and a file in it gets one
// message, not one for each line.
#pragma once

#include "lang/interp/lexer.hpp"

#include <optional>

namespace kaya::lang {

/// The message about a statement in the newer dialect, with its classic spelling where there is one.
std::optional<Diagnostic> newer_dialect(const Statement& statement);

} // namespace kaya::lang
