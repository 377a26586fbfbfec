#include "base/odd_letters.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

struct OddLetter {
    unsigned code;
    std::string_view instead; ///< a sign, or what to write in words
};

constexpr std::array<OddLetter, 29> odd_letters{{
    {0x00a0, "a blank"}, {0x2007, "a blank"}, {0x202f, "a blank"}, {0x3000, "a blank"}, {0x2028, "a blank"},
    {0x200b, "nothing"}, {0xfeff, "nothing"}, {0x00b0, "nothing"}, {0x2010, "-"},       {0x2011, "-"},
    {0x2012, "-"},       {0x2013, "-"},       {0x2014, "-"},       {0x2212, "-"},       {0x2018, "'"},
    {0x2019, "'"},       {0x00ab, "'"},       {0x00bb, "'"},       {0x00b4, "'"},       {0x201c, "\""},
    {0x201d, "\""},      {0x201e, "\""},      {0x00d7, "*"},       {0x00b7, "*"},       {0x00f7, "/"},
    {0x2026, "..."},     {0x2264, "<="},      {0x2265, ">="},      {0x2260, "#"},
}};

struct Letter {
    unsigned code = 0;
    std::size_t bytes = 1;
};

/// The first letter of a text in UTF-8; of other bytes the byte.
Letter first_letter(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t bytes = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (bytes == 1 || bytes > text.size()) return {first, 1};
    unsigned code = first & (0xffU >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3fU);
    return {code, bytes};
}

std::string hint_for(unsigned code) {
    constexpr unsigned first_wide = 0xff01, last_wide = 0xff5e, first_plain = 0x21; // letters as wide as Chinese ones
    if (code >= first_wide && code <= last_wide)
        return fmt::format("there is the letter U+{:04X} in it: write the plain {}", code,
                           static_cast<char>(code - first_wide + first_plain));
    if (code < 0x20 && code != '\t') return fmt::format("there is the control character {} in it: remove it", code);
    const auto* found = std::ranges::find(odd_letters, code, &OddLetter::code);
    if (found != odd_letters.end()) {
        const bool in_words = found->instead.size() > 3;
        return fmt::format("there is the letter U+{:04X} in it: write {}{}{}", code, in_words ? "" : "the plain ",
                           found->instead, in_words ? " instead" : "");
    }
    return {};
}

template <class Hint> std::string first_hint(std::string_view text, Hint hint) {
    while (!text.empty()) {
        const Letter letter = first_letter(text);
        if (std::string found = hint(letter.code); !found.empty()) return found;
        text.remove_prefix(letter.bytes);
    }
    return {};
}

} // namespace

std::string odd_letter_hint(std::string_view text) { return first_hint(text, hint_for); }

std::string odd_word_hint(std::string_view text) {
    return first_hint(text, [](unsigned code) {
        constexpr unsigned greek = 0x370, cyrillic = 0x400, end = 0x530;
        if (code < greek || code >= end) return hint_for(code);
        return fmt::format("there is the letter U+{:04X} in it, which is {}: words of commands are Latin", code,
                           code < cyrillic ? "Greek" : "Cyrillic");
    });
}

std::string odd_digit_hint(std::string_view text) {
    return first_hint(text, [](unsigned code) {
        auto known = hint_for(code);
        if (!known.empty() || code < 0x80) return known;
        return fmt::format("there is the letter U+{:04X} in it: numbers have plain digits, a point and e", code);
    });
}

} // namespace kaya
