#include "commands/program/text_table.hpp"

#include <algorithm>
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

} // namespace kaya
