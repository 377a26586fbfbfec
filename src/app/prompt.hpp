// Commands from the keyboard, or from a pipe.
#pragma once

#include "commands/session.hpp"

namespace kaya {

/// Reads commands from the standard input and runs them until `quit` or its end. On a terminal with history,
/// completion of words with the tabulator, and a further prompt while a function, a chunk of Lua or a continued line
/// is open; mistakes are shown and the prompt comes again. From a pipe the first mistake ends it. Gives the exit
/// status.
int run_prompt(Session& session);

/// Where typed lines are kept from one session to the next; empty when there is no home.
std::filesystem::path history_file();

} // namespace kaya
