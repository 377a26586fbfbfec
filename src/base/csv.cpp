#include "base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Spreadsheets take a longer text that begins so for a formula; some take the wide forms of East Asia for the same.
constexpr std::string_view formula_begins[]{"=",  "+",      "-",      "@",      "\t",    "\r",
                                            "\n", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};

bool is_number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error != std::errc::invalid_argument && end == text.data() + text.size();
}

bool is_formula(std::string_view text) {
    return std::ranges::any_of(formula_begins,
                               [text](std::string_view begin) {
                                   return text.starts_with(begin) && text != begin; // a lone "-" is a unit
                               }) &&
           !is_number(text);
}

} // namespace

std::string csv_cell(std::string_view text) {
    std::string result = is_formula(text) ? "'" : "";
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return result.append(text);
    result.insert(0, 1, '"');
    for (const char c : text) result.append(c == '"' ? 2 : 1, c);
    return result + '"';
}

std::string csv_cell(double number) { return std::isnan(number) ? std::string() : fmt::format("{}", number); }

} // namespace kaya
