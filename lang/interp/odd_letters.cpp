#include "lang/interp/odd_letters.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

struct OddLetter {
    std::string_view bytes;
    unsigned code;
    std::string_view instead;
};

constexpr std::array<OddLetter, 18> odd_letters{{
    {"\u00a0", 0x00a0, "a blank"},
    {"\u2007", 0x2007, "a blank"},
    {"\u202f", 0x202f, "a blank"},
    {"\u3000", 0x3000, "a blank"},
    {"\u200b", 0x200b, "nothing"},
    {"\ufeff", 0xfeff, "nothing"},
    {"\u2010", 0x2010, "-"},
    {"\u2011", 0x2011, "-"},
    {"\u2012", 0x2012, "-"},
    {"\u2013", 0x2013, "-"},
    {"\u2014", 0x2014, "-"},
    {"\u2212", 0x2212, "-"},
    {"\u2018", 0x2018, "'"},
    {"\u2019", 0x2019, "'"},
    {"\u201c", 0x201c, "\""},
    {"\u201d", 0x201d, "\""},
    {"\u201e", 0x201e, "\""},
    {"\u00d7", 0x00d7, "*"},
}};

/// For Greek and Cyrillic letters, two bytes of UTF-8 each: many look like Latin ones.
std::string other_alphabet(std::string_view text) {
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        const auto high = static_cast<unsigned char>(text[i]), low = static_cast<unsigned char>(text[i + 1]);
        if (high < 0xcd || high > 0xd3 || (low & 0xc0U) != 0x80) continue;
        const unsigned code = (high & 0x1fU) << 6U | (low & 0x3fU);
        return fmt::format("there is the letter U+{:04X} in it, which is {}: words of commands are Latin", code,
                           code < 0x400 ? "Greek" : "Cyrillic");
    }
    return {};
}

} // namespace

std::string odd_letter_hint(std::string_view text) {
    std::size_t first = text.npos;
    const OddLetter* found = nullptr;
    for (const auto& letter : odd_letters)
        if (const auto at = text.find(letter.bytes); at < first) {
            first = at;
            found = &letter;
        }
    if (found == nullptr) return other_alphabet(text);
    const bool named = found->instead.size() > 1;
    return fmt::format("there is the letter U+{:04X} in it: write {}{}{}", found->code, named ? "" : "the plain ",
                       found->instead, named ? " instead" : "");
}

} // namespace kaya::lang
