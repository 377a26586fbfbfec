#include "lang/fish/lexer.hpp"

#include "base/lower_case.hpp"
#include "base/odd_letters.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Letters of any language may be part of a name: bytes beyond ASCII are accepted.
bool starts_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' ||
           static_cast<unsigned char>(c) >= 0x80;
}
bool continues_name(char c) { return starts_name(c) || is_digit(c) || c == '.'; }

constexpr std::array<std::string_view, 19> signs{"<=", ">=", "==", "!=", "<>", "+", "-", "*", "/", "^",
                                                 "(",  ")",  ",",  "=",  "#",  "<", ">", "&", "|"};
/// Looked for first, in the modern dialect.
constexpr std::array<std::string_view, 15> modern_signs{"+=::", "-=::", "*=::", "/=::", "=::", "::", "->", "//",
                                                        "+=",   "-=",   "*=",   "/=",   ":=",  "%",  "~"};

/// What FISH writes in place of a sign of other languages; empty for others.
const char* hint_for_sign(char sign) {
    switch (sign) {
    case '[':
    case ']': return "elements of an array stand in parentheses: a(1)";
    case '%': return "the remainder is a - b * int(a / b); `fish define` takes a % b";
    case ':': return "FISH writes a = b; a colon has no place in a function";
    case '{':
    case '}': return "FISH writes end, endif and endloop in place of braces";
    case '~': return "FISH writes # for unequal";
    case '.': return "`fish define` reads names with points; `define` has b_mass(b) and the like";
    default: return "";
    }
}

/// A quote, a minus or a blank of a word processor in a name or a number; letters of other alphabets may be in names.
void refuse_odd_letter(std::string_view text, const Place& place) {
    const std::string hint = odd_letter_hint(text);
    if (!hint.empty())
        throw Diagnostic(fmt::format("'{}' has a letter without a meaning in FISH", text), hint).at(place);
}

/// More digits than any 32 bit integer has: the classic program makes a real number of it.
constexpr std::size_t most_integer_digits = 10;

} // namespace

std::size_t end_of_code(std::string_view line) {
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (quote) {
            if (line[i] == quote) quote = 0;
        } else if (line[i] == '\'' || line[i] == '"') {
            quote = line[i];
        } else if (line[i] == ';') {
            return i;
        }
    }
    return line.size();
}

bool is_continued(std::string_view line, std::size_t& length) {
    length = end_of_code(line);
    while (length > 0 && is_blank(line[length - 1])) --length;
    if (length > 0 && line[length - 1] == '&') {
        length -= 1;
        return true;
    }
    if (length >= 3 && line.substr(length - 3, 3) == "...") {
        length -= 3;
        return true;
    }
    return false;
}

struct Lexer::Cursor {
    std::string_view code;
    std::size_t line;
    std::size_t at = 0;

    bool done() const { return at >= code.size(); }
    char peek(std::size_t ahead = 0) const { return at + ahead < code.size() ? code[at + ahead] : '\0'; }
};

Lexer::Lexer(const std::string& text, const Place& first) : first_(first) {
    std::string line;
    for (const char c : text) {
        if (c == '\n') {
            lines_.push_back(std::move(line));
            line.clear();
        } else {
            line += c;
        }
    }
    if (!line.empty()) lines_.push_back(std::move(line));
}

Place Lexer::place(std::size_t line, std::size_t column, std::size_t length) const {
    // Only the first line of the text may begin in the middle of a line of the deck.
    const int shift = line == 0 ? std::max(first_.column, 1) : 1;
    return {first_.source, first_.line + static_cast<int>(line), static_cast<int>(column) + shift,
            static_cast<int>(length)};
}

Place Lexer::here() const {
    if (next_ == 0) return place(0, 0, 1);
    return place(next_ - 1, 0, std::max<std::size_t>(1, lines_[next_ - 1].size()));
}

bool Lexer::next_line(std::vector<Token>& tokens) {
    while (next_ < lines_.size()) {
        tokens.clear();
        if (scan_line(tokens)) return true;
    }
    return false;
}

bool Lexer::scan_line(std::vector<Token>& tokens) {
    for (bool continued = true; continued;) {
        if (next_ == lines_.size())
            throw Diagnostic("the last line ends with a continuation mark", "remove the '&' or '...'").at(here());
        const std::string& line = lines_[next_];
        std::size_t length = 0;
        continued = is_continued(line, length);
        Cursor cursor{std::string_view(line).substr(0, length), next_};
        ++next_;
        for (;;) {
            while (is_blank(cursor.peek()) && !cursor.done()) ++cursor.at;
            if (cursor.done()) break;
            scan_token(cursor, tokens);
        }
        if (!continued) {
            Token end;
            end.place = place(cursor.line, length, 1);
            tokens.push_back(end);
        }
    }
    return tokens.size() > 1;
}

void Lexer::scan_token(Cursor& cursor, std::vector<Token>& tokens) const {
    const char c = cursor.peek();
    if (is_digit(c) || (c == '.' && is_digit(cursor.peek(1)))) return scan_number(cursor, tokens);
    if (c == '\'' || c == '"') return scan_text(cursor, tokens);

    Token token;
    const std::size_t from = cursor.at;
    if (starts_name(c)) {
        while (!cursor.done() && continues_name(cursor.peek())) ++cursor.at;
        refuse_odd_letter(cursor.code.substr(from, cursor.at - from), place(cursor.line, from, cursor.at - from));
        token.kind = TokenKind::name;
        token.text = lower_case(cursor.code.substr(from, cursor.at - from));
    } else {
        const auto try_signs = [&](const auto& all) {
            for (const auto sign : all)
                if (token.text.empty() && cursor.code.substr(from, sign.size()) == sign) token.text = sign;
        };
        if (dialect_ == Dialect::modern) try_signs(modern_signs);
        try_signs(signs);
        cursor.at += token.text.size();
        if (token.text == ":=") token.text = "=";
        if (token.text.empty())
            throw Diagnostic(fmt::format("'{}' has no meaning in FISH", c), hint_for_sign(c))
                .at(place(cursor.line, from, 1));
        token.kind = TokenKind::sign;
    }
    token.place = place(cursor.line, from, cursor.at - from);
    tokens.push_back(std::move(token));
}

void Lexer::scan_number(Cursor& cursor, std::vector<Token>& tokens) const {
    const std::size_t from = cursor.at;
    bool is_real = false;
    while (is_digit(cursor.peek())) ++cursor.at;
    const std::size_t digits = cursor.at - from;
    if (cursor.peek() == '.') {
        is_real = true;
        ++cursor.at;
        while (is_digit(cursor.peek())) ++cursor.at;
    }
    if (cursor.peek() == 'e' || cursor.peek() == 'E') {
        const std::size_t sign = cursor.peek(1) == '+' || cursor.peek(1) == '-' ? 1 : 0;
        if (is_digit(cursor.peek(1 + sign))) {
            is_real = true;
            cursor.at += 1 + sign;
            while (is_digit(cursor.peek())) ++cursor.at;
        }
    }
    const std::string_view text = cursor.code.substr(from, cursor.at - from);
    const Place where = place(cursor.line, from, text.size());
    if (starts_name(cursor.peek()))
        refuse_odd_letter(cursor.code.substr(from, cursor.code.find(' ', from) - from), where);
    if (starts_name(cursor.peek()))
        throw Diagnostic(fmt::format("'{}{}' is neither a number nor a name", text, cursor.peek()),
                         "a name must not begin with a digit")
            .at(where);

    Token token;
    token.text = text;
    token.place = where;
    if (is_real || digits > most_integer_digits) {
        token.kind = TokenKind::real;
        const auto result = std::from_chars(text.data(), text.data() + text.size(), token.real);
        if (result.ec == std::errc::result_out_of_range)
            throw Diagnostic(fmt::format("{} is beyond the range of numbers", text)).at(where);
    } else {
        token.kind = TokenKind::integer;
        std::from_chars(text.data(), text.data() + text.size(), token.integer);
    }
    tokens.push_back(std::move(token));
}

void Lexer::scan_text(Cursor& cursor, std::vector<Token>& tokens) const {
    const std::size_t from = cursor.at;
    const char quote = cursor.peek();
    Token token;
    token.kind = TokenKind::text;
    for (++cursor.at;; ++cursor.at) {
        if (cursor.done())
            throw Diagnostic("the text has no closing quote", fmt::format("put {} after it", quote))
                .at(place(cursor.line, from, cursor.code.size() - from));
        const char c = cursor.peek();
        if (c == quote) {
            if (cursor.peek(1) != quote) break;
            ++cursor.at; // a doubled quote is one quote
        } else if (c == '\\' && (cursor.peek(1) == 'n' || cursor.peek(1) == 't')) {
            ++cursor.at;
            token.text += cursor.peek() == 'n' ? '\n' : '\t';
            continue;
        }
        token.text += c;
    }
    ++cursor.at;
    token.place = place(cursor.line, from, cursor.at - from);
    tokens.push_back(std::move(token));
}

bool Lexer::next_raw_line(RawLine& raw) {
    if (next_ == lines_.size()) return false;
    raw.place = place(next_, 0, std::max<std::size_t>(1, lines_[next_].size()));
    raw.text.clear();
    for (bool continued = true; continued && next_ < lines_.size(); ++next_) {
        std::size_t length = 0;
        continued = is_continued(lines_[next_], length);
        if (!raw.text.empty()) raw.text += '\n';
        raw.text += lines_[next_].substr(0, end_of_code(lines_[next_]));
    }
    return true;
}

} // namespace kaya::fish
