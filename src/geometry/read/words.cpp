#include "geometry/read/words.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {
namespace {

/// A word as a message may show it: no control characters, not too long.
std::string shown(std::string_view word) {
    std::string text(word.substr(0, 30));
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return text;
}

} // namespace

bool same_word(std::string_view a, std::string_view b) { return equal_ignoring_case(a, b); }

bool Words::blank(char c) const {
    return c == ' ' || c == '\t' || c == '\r' || separators_.find(c) != std::string_view::npos;
}

void Words::skip_blanks() {
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
    if (at_ < text_.size() && comments_.find(text_[at_]) != std::string_view::npos)
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

std::string_view Words::next_in_line() {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] == '\n') return {};
    const char quote = text_[at_];
    if (quote == '"' || quote == '\'') {
        const std::size_t end = text_.find_first_of(quote == '"' ? "\"\n" : "'\n", at_ + 1);
        if (end == std::string_view::npos || text_[end] == '\n') fail("a quote is not closed");
        const std::string_view word = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return word;
    }
    const std::size_t begin = at_;
    // Brackets are separate words.
    static constexpr std::string_view brackets = "[]{}";
    if (brackets.find(text_[at_]) != std::string_view::npos) return text_.substr(at_++, 1);
    while (at_ < text_.size() && text_[at_] != '\n' && !blank(text_[at_]) &&
           brackets.find(text_[at_]) == std::string_view::npos && comments_.find(text_[at_]) == std::string_view::npos)
        ++at_;
    return text_.substr(begin, at_ - begin);
}

void Words::skip_to_word() {
    stops_.pass();
    for (skip_blanks(); at_ < text_.size() && text_[at_] == '\n'; skip_blanks()) {
        ++at_;
        ++line_;
    }
}

std::string_view Words::next() {
    for (;;) {
        skip_to_word();
        const std::string_view word = next_in_line();
        // Only an empty pair of quotes is empty before the end of the text.
        if (!word.empty() || at_ >= text_.size()) return word;
    }
}

std::string_view Words::peek() {
    const std::size_t at = at_;
    const int line = line_;
    const std::string_view word = next();
    at_ = at;
    line_ = line;
    return word;
}

void Words::skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

void Words::fail(const std::string& message, const std::string& hint) const {
    throw Diagnostic(fmt::format("{}, line {}: {}", file_, line_, message), hint);
}

double Words::to_number(std::string_view word, std::string_view what) const {
    if (word.empty()) fail(fmt::format("{} is missing", what));
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
        fail(fmt::format("'{}' is not a number: expected {}", shown(word), what));
    return value;
}

long long Words::to_integer(std::string_view word, std::string_view what) const {
    if (word.empty()) fail(fmt::format("{} is missing", what));
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    long long value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size())
        fail(fmt::format("'{}' is not a whole number: expected {}", shown(word), what));
    return value;
}

double Words::number(std::string_view what) { return to_number(next(), what); }
long long Words::integer(std::string_view what) { return to_integer(next(), what); }
double Words::number_in_line(std::string_view what) { return to_number(next_in_line(), what); }
long long Words::integer_in_line(std::string_view what) { return to_integer(next_in_line(), what); }

Vec3 Words::point(std::string_view what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
}

long long Words::count(std::string_view what) {
    const long long number = integer(what);
    if (number < 0) fail(fmt::format("{} is {}", what, number));
    return number;
}

int Words::identity(long long number, std::string_view what) const {
    if (number < 1 || number > std::numeric_limits<int>::max())
        fail(fmt::format("{} is {}, and must be above 0", what, number));
    return static_cast<int>(number);
}

void Words::end_line() {
    if (const std::string_view rest = next_in_line(); !rest.empty())
        fail(fmt::format("'{}' is one word too many", rest.substr(0, 30)));
}

void Words::expect(std::string_view word) {
    const std::string_view found = next();
    if (same_word(found, word)) return;
    if (found.empty()) fail(fmt::format("the file ends before '{}'", word));
    fail(fmt::format("expected '{}', found '{}'", word, shown(found)));
}

} // namespace kaya
