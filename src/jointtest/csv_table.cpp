#include "jointtest/csv_table.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

namespace kaya {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    while (true) {
        const auto comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == line.npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

double number_of(std::string_view cell, const std::filesystem::path& file, int line) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        throw Diagnostic(fmt::format("{}, line {}: '{}' stands where a number must be", file.string(), line, cell),
                         "columns are parted by commas, and the first line has their names");
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
    std::ifstream stream(file);
    if (!stream) throw Diagnostic(fmt::format("there is no file {}", file.string()), "give the path from the working folder");
    CsvTable table;
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const auto text = trimmed(line);
        if (text.empty() || text.front() == '#') continue;
        const auto cells = cells_of(text);
        if (table.names.empty()) {
            for (const auto cell : cells) table.add(std::string(cell), {});
            continue;
        }
        if (cells.size() != table.names.size())
            throw Diagnostic(fmt::format("{}, line {}: {} numbers where the first line has {} names", file.string(), number,
                                         cells.size(), table.names.size()),
                             "give every column a number in every row");
        for (std::size_t k = 0; k < cells.size(); ++k)
            table.columns[k].push_back(number_of(cells[k], file, number));
    }
    return table;
}

void write_csv(const CsvTable& table, const std::filesystem::path& file) {
    std::ofstream stream(file);
    stream << fmt::format("{}\n", fmt::join(table.names, ","));
    for (std::size_t row = 0; row < table.rows(); ++row) {
        for (std::size_t k = 0; k < table.columns.size(); ++k)
            stream << (k ? "," : "") << fmt::format("{:.17g}", table.columns[k][row]);
        stream << '\n';
    }
    stream.close();
    if (!stream)
        throw Diagnostic(fmt::format("{} could not be written", file.string()), "is the folder there, and is there room?",
                         Fault::run);
}

} // namespace kaya
