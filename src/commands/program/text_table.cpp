#include "commands/program/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

bool is_like_number(const std::string& word) {
    if (word.empty()) return true;
    if (word == "nan" || word == "inf" || word == "-inf") return true;
    return word.find_first_not_of("0123456789+-.e(), ") == std::string::npos &&
           word.find_first_of("0123456789") != std::string::npos;
}

} // namespace

std::string TextTable::text() const {
    const std::size_t columns = rows_.front().size();
    std::vector<std::size_t> width(columns, 0);
    std::vector<bool> numeric(columns, rows_.size() > 1);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        for (std::size_t k = 0; k < columns; ++k) {
            width[k] = std::max(width[k], rows_[i][k].size());
            if (i > 0 && !is_like_number(rows_[i][k])) numeric[k] = false;
        }

    std::string text;
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t k = 0; k < columns; ++k) {
            if (k > 0) line += "  ";
            line += numeric[k] ? fmt::format("{:>{}}", row[k], width[k]) : fmt::format("{:<{}}", row[k], width[k]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    if (!text.empty()) text.pop_back();
    return text;
}

std::string number_text(double value) { return fmt::format("{:g}", value == 0 ? 0.0 : value); }

std::string vector_text(const Vec3& vector) {
    return fmt::format("({}, {}, {})", number_text(vector[0]), number_text(vector[1]), number_text(vector[2]));
}

std::string coordinates_text(const Vec3& place) {
    constexpr double far = 1e4, farther = 1e12, thousandth = 1e-3;
    const auto text = [&](double value) {
        const double size = std::abs(value);
        if (!(size >= far && size < farther)) return number_text(value);
        return fmt::format("{}", std::round(value / thousandth) / (1 / thousandth));
    };
    return fmt::format("{}, {}, {}", text(place[0]), text(place[1]), text(place[2]));
}

std::string place_text(const Vec3& place) { return fmt::format("({})", coordinates_text(place)); }

} // namespace kaya
