// From words to a typed command: finds the entry of the table and fills its struct.
#pragma once

#include "lang/interp/reader.hpp"

#include <any>

namespace kaya::lang {

/// A word that is read as a name: of FISH, or of a range.
struct BareName {
    std::size_t word = 0; ///< its index in the statement
    bool range = false;
};

/// One command, ready to be run.
struct BoundCommand {
    const CommandSpec* spec = nullptr;
    const Language* language = nullptr; ///< by which it was bound
    bool modern = false;                ///< its line is of the modern dialect
    Dialects dialects = Dialects::both; ///< that were read there
    Place place;                        ///< of its first word
    int last_line = 0;
    std::any command;                      ///< the struct of lang/commands/commands.hpp
    bool late = false;                     ///< holds wildcards: to be bound again with values when it is reached
    std::vector<std::string_view> ignored; ///< its words that are without effect, in whole
    std::vector<BareName> bare; ///< to be read in this order before the statement is bound, see bare_names.hpp

    /// The statement in one line, words as typed with single blanks between them; a body follows unchanged.
    std::string text() const;
};

/// Calls `visit` with each command of the language, in the order in which abbreviated words are looked up.
template <class Visit> void for_each_command(const Language& language, Visit visit) {
    for (const auto& family : language.families)
        for (const auto& command : family.commands) visit(command);
}

/// The command that the first words of the statement name. Throws Diagnostic.
struct FoundCommand {
    const CommandSpec* spec = nullptr;
    std::size_t form_at = 0; ///< index of the last word of its form, 0 without one
};
FoundCommand find_command(const Language& language, const Statement& statement);

/// Throws Diagnostic for the first mistake in the statement. Without `values` names bind to wildcards. A word `?` throws a Diagnostic of
/// severity note that lists the valid words. `spelled` receives the whole words of abbreviated ones.
BoundCommand bind_statement(const Language& language, const Statement& statement, const ValueSource* values = nullptr,
                            Spelled* spelled = nullptr);

/// The next statement with its body (def ... end), or false at the end of the text. Throws Diagnostic when the body has no end; the lexer
/// is then after the text that was read.
bool next_statement(const Language& language, Lexer& lexer, Statement& statement);

} // namespace kaya::lang
