// Lines of text files with numbers: points, grids, pits.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace kaya {

/// Words of a line, with blanks, commas or semicolons between them.
inline std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    std::size_t at = 0;
    const auto between = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; };
    while (at < line.size()) {
        while (at < line.size() && between(line[at])) ++at;
        const std::size_t first = at;
        while (at < line.size() && !between(line[at])) ++at;
        if (at > first) words.push_back(line.substr(first, at - first));
    }
    return words;
}

/// A whole word that is a finite number.
inline std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Calls visit(line number, line) for each line.
template <class Visit> void each_line(std::string_view text, Visit visit) {
    int count = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        visit(++count, text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

} // namespace kaya
