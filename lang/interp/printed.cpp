#include "lang/interp/printed.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kaya::lang {

bool print_value(PrintedWords& to, double value) {
    if (!std::isfinite(value)) return false;
    std::array<char, 32> digits{};
    std::string text(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    // 1e-6 and 1e6, not 1e-06 and 1e+06
    if (const auto e = text.find('e'); e != text.npos) {
        if (text[e + 1] == '+') text.erase(e + 1, 1);
        const std::size_t exponent = e + 1 + (text[e + 1] == '-');
        if (text[exponent] == '0') text.erase(exponent, 1);
    }
    to.push_back({std::move(text)});
    return true;
}

bool print_value(PrintedWords& to, std::int64_t value) {
    to.push_back({fmt::format("{}", value)});
    return true;
}

bool print_value(PrintedWords& to, bool value) {
    to.push_back({value ? "on" : "off"});
    return true;
}

bool print_value(PrintedWords& to, const std::string& value) {
    if (value.empty()) return false;
    to.push_back({value, true});
    return true;
}

bool print_value(PrintedWords& to, const Vec3& value) {
    return print_value(to, value.x()) && print_value(to, value.y()) && print_value(to, value.z());
}

bool print_any(PrintedWords& to, const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return print_value(to, *whole);
    if (const auto* text = std::get_if<std::string>(&value)) return print_value(to, *text);
    const auto* number = std::get_if<double>(&value);
    if (number == nullptr || !print_value(to, *number)) return false;
    std::string& text = to.back().text;
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return true;
}

namespace {

/// Whether the lexer reads the text without quotes as one word with the same letters.
bool is_plain(std::string_view text) {
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !text.empty() && letter(text.front()) && text.back() != '.' && std::ranges::all_of(text, [&](char c) {
        return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-';
    });
}

std::string in_quotes(std::string_view text) {
    std::string to = "'";
    for (const char c : text) to.append(c == '\'' ? 2 : 1, c);
    return to + '\'';
}

} // namespace

std::string joined(const PrintedWords& words, bool quote_all_names) {
    std::string line;
    for (const PrintedWord& word : words) {
        if (!line.empty()) line += ' ';
        line += word.name && (quote_all_names || !is_plain(word.text)) ? in_quotes(word.text) : word.text;
    }
    return line;
}

} // namespace kaya::lang
