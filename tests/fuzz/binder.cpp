// Statements of a deck with the tables of the language, without and with values for @names; help and completion of the same text. No
// command is run and no file is read.
#include "harness.hpp"

#include "lang/modern/language.hpp"
#include "lang/interp/bare_names.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/deck.hpp"
#include "lang/interp/help.hpp"

#include <cstdlib>
#include <functional>

using namespace kaya;

namespace {

/// A value from a script, derived from the letters of the expression.
lang::Value value_of(const std::string& expression, const Place& place) {
    switch (std::hash<std::string>{}(expression) % 7) {
    case 0: return std::monostate{};
    case 1: return true;
    case 2: return std::int64_t{-3};
    case 3: return 0.5;
    case 4: return std::string("left wall");
    case 5: return Vec3(1, 2, 3);
    default: throw Diagnostic("no such name").at(place);
    }
}

/// False if there was an error in the text.
template <class Action> bool survive(Action action) {
    try {
        action();
        return true;
    } catch (const Diagnostic& mistake) {
        if (mistake.message.empty() || render(mistake, true).empty()) std::abort();
        return false;
    }
}

/// More errors in one text find no new defects and take most of the time, because each is compared with all words of the language.
constexpr int most_mistakes = 4;

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string text = fuzz::text_of(data, size);
    const lang::Language& language = lang::language();
    const lang::ValueSource values = value_of;
    survive([&] {
        lang::BareNames names;
        lang::Lexer lexer(lang::source_from_text("fuzz", text));
        for (int left = most_mistakes; left > 0;) {
            lang::Statement statement;
            bool more = false, late = false;
            survive([&] { more = lang::next_statement(language, lexer, statement); });
            if (!more) break;
            left -= survive([&] {
                const auto bound = lang::bind_with_names(language, statement, names);
                names.learn(*bound.spec, statement);
                for (const lang::BareName& name : bound.bare) lang::read_as_name(statement, name);
                late = bound.late;
                (void)bound.text();
            })
                        ? 0
                        : 1;
            if (late) survive([&] { (void)lang::bind_statement(language, statement, &values).text(); });
        }
    });
    survive([&] { (void)lang::needs_more(language, text); });
    const std::string line = text.substr(0, text.find('\n'));
    survive([&] { (void)lang::completions(language, line); });
    survive([&] { (void)lang::help_on(language, line); });
    return 0;
}
