// What the tables say about themselves: help, usage lines, and what may be typed next.
#pragma once

#include "lang/interp/spec.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

/// "poly brick x1 x2 [y1 y2] [z1 z2] [region n] ...": optional parts in brackets, classic order.
std::string usage(const CommandSpec& command);

/// All commands, one line each, by family.
std::string help_list(const Language& language);

/// About one command ("poly", "hist write"), or about a keyword ("xvel": where it may stand).
/// Throws Diagnostic with a suggestion when the word is unknown.
std::string help_on(const Language& language, std::string_view words);

/// What may stand at the end of an unfinished line: whole words that start with what is typed of the last
/// one. Empty where a number or a name of the user must stand.
std::vector<std::string> completions(const Language& language, std::string_view line);

} // namespace kaya::lang
