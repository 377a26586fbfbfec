// From lines to words. A statement is one logical line: continuation marks are already resolved.
#pragma once

#include "lang/interp/source.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya::lang {

enum class WordKind {
    word,       ///< a bare word: prop, brick, tunnel.dat
    number,     ///< 1, -0.5, 1e-6
    text,       ///< 'quoted' or "quoted"
    symbol,     ///< @name or @name(arguments)
    expression, ///< [expression]
    open        ///< a quote, bracket or parenthesis that is never closed
};

struct Word {
    WordKind kind = WordKind::word;
    std::string text;   ///< as typed, without quotes, @ and brackets
    std::string folded; ///< in lower case; the text of a quoted word is folded as well
    double number = 0;  ///< of a number
    bool whole = false; ///< a number without point and exponent that fits into 64 bits
    std::int64_t integer = 0;
    Place place; ///< of the word as typed, quotes and @ included

    /// Known only when a script language has evaluated it.
    bool late() const { return kind == WordKind::symbol || kind == WordKind::expression; }
    /// The text in the line, including quotes.
    std::string raw_text() const;
    /// As messages call it: 'brick', or the text 'left wall'.
    std::string shown() const;
};

/// Which lines are read: those of both dialects, or of one only (`dialect modern`).
enum class Dialects { both, classic, modern };

struct Statement {
    std::vector<Word> words; ///< never empty
    Dialects dialects = Dialects::both;
    int first_line = 0, last_line = 0;
    std::string body; ///< lines that belong to it (def ... end, lua ... endlua, a bracket over several lines), see Body
    Place body_place; ///< of the first line of `body`

    /// The text as typed from word `first` on, comments and continuation marks left out.
    std::string raw(std::size_t first) const;
};

/// Returns the statements in order; blank and comment lines are skipped. Never throws: an unclosed quote or bracket becomes a word of kind
/// `open`, because a title or a plot line may hold any text.
class Lexer {
public:
    explicit Lexer(Source source, int first_line = 1) : source_(std::move(source)), line_(first_line) {}

    /// False at the end of the text.
    bool next(Statement& statement);

    /// The words of one line alone, without continuation: for finding the line that ends a body.
    std::vector<Word> words_of_line(int line) const;

    /// True when the line ends in a continuation mark.
    bool continued(int line) const;

    int line() const { return line_; } ///< the next line to be read
    void go_to(int line) { line_ = line; }
    void read_only(Dialects dialects) { dialects_ = dialects; } ///< of the statements from now on
    const Source& source() const { return source_; }

private:
    bool read_bracket(Statement& statement);
    /// Appends the words of one line; true when the line is continued on the next.
    bool read_line(int line, std::vector<Word>& words) const;

    Source source_;
    int line_ = 1;
    Dialects dialects_ = Dialects::both;
};

/// ASCII letters in lower case; other bytes are unchanged.
std::string fold(std::string_view text);

} // namespace kaya::lang
