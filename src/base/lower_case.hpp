// Words of decks and names of files in lower case: ASCII letters only, independent of the locale.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace kaya {

constexpr char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = lower_case(c);
    return lower;
}

inline bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char one, char other) { return lower_case(one) == lower_case(other); });
}

} // namespace kaya
