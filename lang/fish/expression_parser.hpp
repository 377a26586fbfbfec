// Expressions of FISH, by recursive descent over the tokens of one line.
#pragma once

#include "lang/fish/lexer.hpp"
#include "lang/fish/syntax.hpp"

#include <string_view>
#include <vector>

namespace kaya::fish {

/// The tokens of a line and how far they are read.
class Line {
public:
    Line() { restart(); }

    std::vector<Token> tokens; ///< ends with end_of_line
    Dialect dialect = Dialect::classic;

    void restart(std::size_t at = 0) { at_ = at; }
    std::size_t at() const { return at_; }
    const Token& peek(std::size_t ahead = 0) const { return tokens[std::min(at_ + ahead, tokens.size() - 1)]; }
    const Token& take() { return tokens[at_ + 1 < tokens.size() ? at_++ : at_]; }
    bool done() const { return peek().kind == TokenKind::end_of_line; }
    bool take_sign(std::string_view sign);
    bool take_name(std::string_view name);
    /// Takes the sign or throws "expected ')' ...".
    void expect_sign(std::string_view sign, std::string_view why);
    /// Takes a name or throws: `what` is the purpose of the name ("name of the loop variable").
    const Token& expect_name(std::string_view what);
    /// Throws when something is left on the line.
    void expect_end(std::string_view after);

private:
    std::size_t at_ = 0;
};

/// Reads the longest expression at the current token.
Node parse_expression(Line& line);
/// name or name(arguments)
Node parse_name(Line& line);
/// "expected X, found Y" at the current token.
[[noreturn]] void fail_expected(const Line& line, std::string_view expected, std::string hint = {});
/// Probable meaning of a line that begins with this name and continues without a '='; empty when it is unknown.
std::string hint_for_missing_equals(const Line& line, std::string_view name);

} // namespace kaya::fish
