// Words that decks do not take anywhere: with odd letters, comments of other languages, units.
#pragma once

#include "lang/interp/lexer.hpp"

#include <string>

namespace kaya::lang {

/// What to write in place of the word number `at` of a statement; empty when it looks like none of these.
std::string slip_hint(const Statement& statement, std::size_t at);

} // namespace kaya::lang
