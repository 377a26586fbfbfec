// Words of FISH, one logical line at a time: continued lines are joined, comments dropped.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/fish/dialect.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::fish {

enum class TokenKind { name, integer, real, text, sign, end_of_line };

struct Token {
    TokenKind kind = TokenKind::end_of_line;
    std::string text; ///< a name in lower case, a text without its quotes, or the sign itself
    std::int64_t integer = 0;
    double real = 0;
    Place place;

    bool is_sign(std::string_view sign) const { return kind == TokenKind::sign && text == sign; }
    bool is_name(std::string_view name) const { return kind == TokenKind::name && text == name; }
};

/// A line inside `command ... endcommand`, not cut into words; several when they are continued.
struct RawLine {
    std::string text;
    Place place;
};

class Lexer {
public:
    /// `first` is the place where `text` begins.
    Lexer(const std::string& text, const Place& first);

    /// Signs that only the modern dialect has are refused before.
    void read_as(Dialect dialect) { dialect_ = dialect; }

    /// False when the text is used up. Lines without words are skipped; the last token is end_of_line.
    bool next_line(std::vector<Token>& tokens);
    bool next_raw_line(RawLine& line);

    /// Place of the last character read, for "ends here" messages.
    Place here() const;

private:
    struct Cursor;
    bool scan_line(std::vector<Token>& tokens);
    void scan_token(Cursor& cursor, std::vector<Token>& tokens) const;
    void scan_number(Cursor& cursor, std::vector<Token>& tokens) const;
    void scan_text(Cursor& cursor, std::vector<Token>& tokens) const;
    Place place(std::size_t line, std::size_t column, std::size_t length) const;

    Place first_;
    Dialect dialect_ = Dialect::classic;
    std::vector<std::string> lines_;
    std::size_t next_ = 0; ///< number of the next line in lines_
};

/// Where a comment begins in `line`, or its length: a `;` outside of quotes.
std::size_t end_of_code(std::string_view line);
/// True when the code ends with `&` or `...`; `length` becomes the length without that mark.
bool is_continued(std::string_view line, std::size_t& length);

} // namespace kaya::fish
