// Helpers to bind one line in a test.
#pragma once

#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/modern/language.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/deck.hpp"

#include <gtest/gtest.h>

namespace kaya::lang {

/// The first command of the text.
inline BoundCommand bound(const std::string& text, const ValueSource* values = nullptr,
                          const Language& by = language()) {
    Lexer lexer(source_from_text("test.3dd", text));
    Statement statement;
    if (!next_statement(by, lexer, statement)) throw std::logic_error("the test has no statement");
    return bind_statement(by, statement, values);
}

template <class Command> Command bound_as(const std::string& text, const ValueSource* values = nullptr) {
    const BoundCommand command = bound(text, values);
    if (command.command.type() != typeid(Command))
        throw std::logic_error("'" + text + "' bound to " + command.spec->name());
    return std::any_cast<Command>(command.command);
}

/// The error in the text; fails the test if there is none.
inline Diagnostic mistake(const std::string& text, const Language& by = language()) {
    try {
        bound(text, nullptr, by);
    } catch (const Diagnostic& d) { return d; }
    ADD_FAILURE() << "'" << text << "' was accepted";
    return Diagnostic("");
}

} // namespace kaya::lang
