#include "jointtest/csv_table.hpp"

#include "base/csv.hpp"
#include "base/diagnostic.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Separators of a file, detected in the line of names. Spreadsheets of many countries write semicolons as separators and decimal commas.
struct Style {
    char between = ',';
    bool decimal_comma = false;

    explicit Style(std::string_view names) {
        if (names.find(';') != names.npos) between = ';';
        else if (names.find('\t') != names.npos) between = '\t';
        decimal_comma = between != ',';
    }
};

std::vector<std::string_view> cells_of(std::string_view line, const Style& style) {
    std::vector<std::string_view> cells;
    while (true) {
        const auto end = line.find(style.between);
        cells.push_back(trimmed(line.substr(0, end)));
        if (end == line.npos) return cells;
        line.remove_prefix(end + 1);
    }
}

/// "Shear displacement" is shear_displacement.
std::string column_name(std::string_view cell) {
    std::string name(cell);
    for (char& c : name)
        c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name;
}

double number_of(std::string cell, const Style& style, const std::filesystem::path& file, int line) {
    if (style.decimal_comma) std::replace(cell.begin(), cell.end(), ',', '.');
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        throw Diagnostic(fmt::format("{}, line {}: expected a number, found '{}'", file.string(), line, cell),
                         "columns are separated by commas, semicolons or tabs, and the first line has their names");
    return value;
}

} // namespace

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

void CsvTable::add(std::string name, std::vector<double> values) {
    names.push_back(std::move(name));
    columns.push_back(std::move(values));
}

CsvTable read_csv(const std::filesystem::path& file) {
    const auto content = file_text(file);
    if (!content)
        throw Diagnostic(fmt::format("there is no file {}", file.string()), "give the path from the working folder");
    std::istringstream stream(*content);
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    CsvTable table;
    std::optional<Style> style;
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        if (++number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
        const auto text = trimmed(line);
        if (text.empty() || text.front() == '#') continue;
        if (!style) {
            style.emplace(text);
            for (const auto cell : cells_of(text, *style)) {
                const std::string name = column_name(cell);
                if (!name.empty() && table.find(name))
                    throw Diagnostic(
                        fmt::format("{}, line {}: two columns are named '{}'", file.string(), number, name),
                        "give each column its name, or leave one out");
                table.add(name, {});
            }
            continue;
        }
        const auto cells = cells_of(text, *style);
        if (cells.size() != table.names.size())
            throw Diagnostic(fmt::format("{}, line {}: {} numbers where the first line has {} names", file.string(),
                                         number, cells.size(), table.names.size()),
                             "give every column a number in every row");
        for (std::size_t k = 0; k < cells.size(); ++k)
            table.columns[k].push_back(number_of(std::string(cells[k]), *style, file, number));
    }
    return table;
}

void write_csv(const CsvTable& table, const std::filesystem::path& file) {
    std::ostringstream stream;
    for (std::size_t k = 0; k < table.names.size(); ++k) stream << (k ? "," : "") << csv_cell(table.names[k]);
    stream << '\n';
    for (std::size_t row = 0; row < table.rows(); ++row) {
        for (std::size_t k = 0; k < table.columns.size(); ++k)
            stream << (k ? "," : "") << fmt::format("{:.17g}", table.columns[k][row]);
        stream << '\n';
    }
    write_whole_file(file.string(), stream.str());
}

} // namespace kaya
