// Where an error points that knows no word of its own.
#pragma once

#include "lang/interp/spec.hpp"

namespace kaya::lang {

/// Places a problem of the command whose first word is at `command`: at the word of it that the message names, such as a file that is
/// not there, else at the first word. A problem that points at some other place keeps it.
void place_problem(Diagnostic& problem, const Language& language, const Place& command);

} // namespace kaya::lang
