// Commands from the keyboard, or from a pipe.
#pragma once

#include "commands/session/session.hpp"

namespace kaya {

/// Reads commands from the standard input and runs them until `quit` or its end. On a terminal with history, completion by the tabulator,
/// and a second prompt while a function, a chunk of Lua or a continued line is open; errors are shown and the prompt returns. Every end but
/// `quit` saves an unsaved model. From a pipe the first error ends it. Returns the exit status.
int run_prompt(Session& session);

/// The file of the line history; empty without a home folder.
std::filesystem::path history_file();

} // namespace kaya
