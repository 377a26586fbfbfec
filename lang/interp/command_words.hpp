// Which command, and which dialect, the first words of a statement name.
#pragma once

#include "lang/interp/spec.hpp"

#include <string_view>
#include <vector>

namespace kaya::lang {

bool is_one_of(const std::vector<Spelling>& spellings, const Word& word);

/// The commands of this dialect whose first word is the one that `typed` abbreviates.
const std::vector<const CommandSpec*>& commands_called(const Language& language, std::string_view typed);

/// How many words of the statement after its first one belong to one of the commands.
std::size_t words_known(const std::vector<const CommandSpec*>& commands, const Statement& statement);
/// How many words of the form of a command follow the first word of the statement.
std::size_t form_depth(const CommandSpec& spec, const Statement& statement);

/// Index of the last word of the form, 0 when the statement does not have it. Options may precede that word.
std::size_t find_form(const CommandSpec& spec, const Statement& statement);

/// Index of the first word from `at` on that is neither an option of the command nor a value of one.
std::size_t past_options(const CommandSpec& spec, const Statement& statement, std::size_t at);

/// The dialect of a line: the one that knows more of its first words; classic when both know as many.
const Language& dialect_of(const Language& language, const Statement& statement);

/// The dialects that `dialect WORD` reads; both for another word.
Dialects dialects_of(std::string_view word);

} // namespace kaya::lang
