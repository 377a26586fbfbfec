// Lines of a `command ... endcommand` block: what is put in at run time is found here.
#pragma once

#include "lang/fish/lexer.hpp"
#include "lang/fish/syntax.hpp"

namespace kaya::fish {

/// Cuts the line at every `[expression]` and `@name` outside of quotes. A piece made from `@name` keeps its
/// text too: only names of local variables are put in here, all others mean something to the command itself
/// (`hist @x` records the variable, it does not record its present value).
CommandLine read_command_line(const RawLine& raw);

/// First word in lower case; empty for a blank line.
std::string first_word(std::string_view text);

} // namespace kaya::fish
