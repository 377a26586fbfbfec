// Commands of a text as lines of each dialect, and the text in the words of each: what is printed reads as the same struct and prints as
// itself, and a converted text is converted no further. No command is run and no file is read.
#include "harness.hpp"

#include "lang/commands/language.hpp"
#include "lang/commands/print.hpp"
#include "lang/commands/struct_text.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/deck.hpp"
#include "lang/modern/convert.hpp"
#include "lang/modern/language.hpp"

#include <cstdio>
#include <cstdlib>

using namespace kaya;

namespace {

[[noreturn]] void fail(const char* what, const std::string& before, const std::string& after) {
    std::fprintf(stderr, "%s:\n%s\n---\n%s\n", what, before.c_str(), after.c_str());
    std::abort();
}

/// The result of reading a text that the program has made.
template <class Action> auto without_mistake(const std::string& text, Action action) {
    try {
        return action();
    } catch (const Diagnostic& mistake) { fail("a mistake in a printed text", text, mistake.message); }
}

std::any read(const std::string& line, const lang::Language& dialect) {
    lang::Lexer lexer(lang::source_from_text("printed", line));
    lang::Statement statement;
    if (!lang::next_statement(dialect, lexer, statement)) fail("no command", line, "");
    return lang::bind_statement(dialect, statement).command;
}

void check_lines(const lang::BoundCommand& bound) {
    for (const lang::Language* dialect : {&lang::classic(), &lang::modern()}) {
        const auto line = lang::line_of(bound.command, *dialect);
        if (!line) continue;
        const std::any again = without_mistake(*line, [&] { return read(*line, *dialect); });
        if (lang::struct_text(again) != lang::struct_text(bound.command)) fail("another struct", bound.text(), *line);
        const auto twice = lang::line_of(again, *dialect);
        if (twice != line) fail("printed in two ways", *line, twice.value_or(""));
    }
}

/// A text with this many commands meets all that a longer one does.
constexpr int most_commands = 20;

/// Up to the first mistake: most texts that have one have more.
void check_commands(const std::string& text) {
    const lang::Language& language = lang::language();
    lang::Lexer lexer(lang::source_from_text("fuzz", text));
    for (int count = 0; count < most_commands; ++count) {
        lang::Statement statement;
        if (!lang::next_statement(language, lexer, statement)) return;
        const lang::BoundCommand bound = lang::bind_statement(language, statement);
        if (!bound.late) check_lines(bound);
    }
}

void check_conversion(const std::string& text, lang::To to) {
    const std::string once = lang::convert_deck(lang::source_from_text("fuzz", text), to).text;
    const std::string twice =
        without_mistake(once, [&] { return lang::convert_deck(lang::source_from_text("converted", once), to).text; });
    if (twice != once) fail("converted twice", once, twice);
}

template <class Action> void unless_mistaken(Action action) {
    try {
        action();
    } catch (const Diagnostic&) {}
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string text = fuzz::text_of(data, size);
    unless_mistaken([&] { check_commands(text); });
    for (const lang::To to : {lang::To::classic, lang::To::modern})
        unless_mistaken([&] { check_conversion(text, to); });
    return 0;
}
