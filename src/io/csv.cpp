#include "io/csv.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

std::string csv_cell(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string result = "\"";
    for (const char c : text) result.append(c == '"' ? 2 : 1, c);
    return result + '"';
}

std::string csv_cell(double number) { return std::isnan(number) ? std::string() : fmt::format("{}", number); }

} // namespace kaya
