// Texts made from the tables: help, usage lines, and completions.
#pragma once

#include "base/units.hpp"
#include "lang/interp/spec.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

/// "poly brick x1 x2 [y1 y2] [z1 z2] [region n] ...": optional parts in brackets, classic order.
std::string usage(const CommandSpec& command);

/// All commands, one line each, by family.
std::string help_list(const Language& language);

/// Help on one command ("poly", "hist write"), or on a keyword ("xvel": where it is valid). Throws Diagnostic with a suggestion when the
/// word is unknown. Quantities are named by `units`.
std::string help_on(const Language& language, std::string_view words, const Units& units = {});

/// Completions of an unfinished line: whole words that start with the typed part of the last word. Empty where a number or a name of the
/// user must follow.
std::vector<std::string> completions(const Language& language, std::string_view line);

} // namespace kaya::lang
