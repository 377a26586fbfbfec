#include "lang/interp/word_slips.hpp"

#include "lang/interp/number_hints.hpp"
#include "base/odd_letters.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kaya::lang {

namespace {

/// The 000 of `1 000 000`.
bool is_group_of_digits(const Statement& statement, std::size_t at) {
    constexpr std::size_t digits = 3;
    const std::string& text = statement.words[at].text;
    return at > 0 && statement.words[at - 1].kind == WordKind::number && text.size() == digits &&
           text.find_first_not_of("0123456789") == text.npos;
}

} // namespace

std::string slip_hint(const Statement& statement, std::size_t at) {
    const Word& word = statement.words[at];
    if (word.kind == WordKind::number)
        return is_group_of_digits(statement, at) ? "digits are not grouped: write them without blanks and commas" : "";
    if (word.kind != WordKind::word) return {};
    if (auto odd = odd_word_hint(word.text); !odd.empty()) return odd;
    constexpr std::array<std::string_view, 5> comments{"//", "/*", "#", "--", "%"};
    const auto begins = [&](std::string_view mark) { return word.text.starts_with(mark); };
    if (word.text.starts_with("%PDF")) return "this is a PDF file: name the command file";
    if (std::ranges::any_of(comments, begins)) return "a comment begins with ;";
    const bool after_number = at > 0 && statement.words[at - 1].kind == WordKind::number;
    return after_number ? unit_hint(statement.words[at - 1].number, word.text) : std::string{};
}

} // namespace kaya::lang
