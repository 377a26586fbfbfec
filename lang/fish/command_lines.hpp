// Lines of a `command ... endcommand` block: finds the parts that are replaced at run time.
#pragma once

#include "lang/fish/lexer.hpp"
#include "lang/fish/syntax.hpp"

namespace kaya::fish {

using ExpressionReader = ExpressionTree (*)(const std::string& text, const Place& place, Dialect dialect);

/// Cuts the line at every `[expression]` and `@name` outside of quotes. A piece made from `@name` keeps its text too: only names of local
/// variables are replaced here. All other names have a meaning for the command itself (`hist @x` records the variable and not its present
/// value). `read_expression` reads the text of an expression at a place.
CommandLine read_command_line(const RawLine& raw, Dialect dialect, ExpressionReader read_expression);

/// First word in lower case; empty for a blank line.
std::string first_word(std::string_view text);

} // namespace kaya::fish
