#include "lang/interp/word_slips.hpp"

#include "lang/interp/number_hints.hpp"
#include "lang/interp/odd_letters.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kaya::lang {

std::string slip_hint(const Statement& statement, std::size_t at) {
    const Word& word = statement.words[at];
    if (word.kind != WordKind::word) return {};
    if (auto odd = odd_letter_hint(word.text); !odd.empty()) return odd;
    constexpr std::array<std::string_view, 5> comments{"//", "/*", "#", "--", "%"};
    const auto begins = [&](std::string_view mark) { return word.text.starts_with(mark); };
    if (std::ranges::any_of(comments, begins)) return "a comment begins with ;";
    const bool after_number = at > 0 && statement.words[at - 1].kind == WordKind::number;
    return after_number ? unit_hint(statement.words[at - 1].number, word.text) : std::string{};
}

} // namespace kaya::lang
