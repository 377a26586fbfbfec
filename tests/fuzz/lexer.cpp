// Both lexers on any bytes: words must be within their lines.
#include "harness.hpp"

#include "lang/fish/lexer.hpp"
#include "lang/interp/lexer.hpp"

#include <cstdlib>

using namespace kaya;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check_place(const Place& place, const SourceText& source) {
    require(place.line >= 1 && place.line <= static_cast<int>(source.lines.size()));
    const std::string& line = source.lines[static_cast<std::size_t>(place.line - 1)];
    require(place.column >= 1 && place.length >= 1);
    require(place.column - 1 + place.length <= static_cast<int>(line.size()));
}

void commands(const std::string& text) {
    try {
        lang::Lexer lexer(lang::source_from_text("fuzz", text));
        lang::Statement statement;
        while (lexer.next(statement)) {
            require(!statement.words.empty());
            for (const auto& word : statement.words) {
                check_place(word.place, *lexer.source());
                require(!word.shown().empty());
            }
            (void)statement.raw(0);
        }
    } catch (const Diagnostic& mistake) { require(!render(mistake, true).empty()); }
}

void functions(const std::string& text) {
    try {
        auto source = std::make_shared<SourceText>();
        source->name = "fuzz";
        fish::Lexer lexer(text, Place{source, 1, 1, 1});
        std::vector<fish::Token> tokens;
        fish::RawLine raw;
        while (lexer.next_line(tokens)) {
            require(!tokens.empty() && tokens.back().kind == fish::TokenKind::end_of_line);
            if (tokens.front().is_name("command") && lexer.next_raw_line(raw)) (void)fish::end_of_code(raw.text);
        }
    } catch (const Diagnostic& mistake) { require(!mistake.message.empty()); }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > fuzz::largest) return 0;
    const std::string text = fuzz::text_of(data, size);
    commands(text);
    functions(text);
    return 0;
}
