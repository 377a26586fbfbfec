// The place of an error that does not know its word.
#pragma once

#include "lang/interp/spec.hpp"

namespace kaya::lang {

/// Places a problem of the command whose first word is at `command`: at the word of it that the message names, such as a missing file, else
/// at the first word. A problem that points at another place keeps it.
void place_problem(Diagnostic& problem, const Language& language, const Place& command);

} // namespace kaya::lang
