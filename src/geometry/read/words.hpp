// Reading the words of a geometry file, with the line in every message. Private to geometry.
#pragma once

#include "base/stop_point.hpp"
#include "base/vector.hpp"

#include <string>
#include <string_view>

namespace kaya {

class Words {
public:
    /// `separators` count as blanks; from any character of `comments` the rest of the line is left out.
    Words(std::string_view text, std::string file, std::string_view separators, std::string_view comments)
        : text_(text), file_(std::move(file)), separators_(separators), comments_(comments) {}

    /// The next word, or empty at the end of the text. Words do not cross lines; a quoted one
    /// loses its quotes.
    std::string_view next();
    /// The next word of the same line, or empty at its end.
    std::string_view next_in_line();
    /// The next word without taking it.
    std::string_view peek();
    void skip_line();
    /// Advances to the line of the next word without reading it.
    void skip_to_word();

    double number(std::string_view what); ///< next word of the text as a finite number
    long long integer(std::string_view what);
    double number_in_line(std::string_view what); ///< the same, and it must be in this line
    long long integer_in_line(std::string_view what);
    Vec3 point(std::string_view what);
    long long count(std::string_view what); ///< a whole number that is not below 0
    /// `number` as what objects of a file are called by: above 0.
    int identity(long long number, std::string_view what) const;
    void end_line();                    ///< refuses a word that is left in this line
    void expect(std::string_view word); ///< refuses any other word; case does not matter

    int line() const { return line_; }
    /// Throws a Diagnostic "file, line n: message".
    [[noreturn]] void fail(const std::string& message, const std::string& hint = {}) const;

private:
    bool blank(char c) const;
    void skip_blanks();
    double to_number(std::string_view word, std::string_view what) const;
    long long to_integer(std::string_view word, std::string_view what) const;

    std::string_view text_;
    std::string file_;
    std::string_view separators_, comments_;
    std::size_t at_ = 0;
    int line_ = 1;
    StopPoints stops_;
};

bool same_word(std::string_view a, std::string_view b); ///< case does not matter

} // namespace kaya
