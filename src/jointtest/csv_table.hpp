// Numbers in columns with names, from and to a CSV file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Columns of equal length. Lines that begin with # are comments; the first other line has the names.
struct CsvTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;

    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
    std::optional<std::size_t> find(std::string_view name) const;
    void add(std::string name, std::vector<double> values);
};

/// Columns are separated by commas, semicolons or tabs, as in the line of names; with semicolons or tabs a number may have a decimal comma.
/// Names are converted to lower case, with underscores for blanks. Throws Diagnostic with file and line when a cell is not a number or a
/// row has another length, and when two columns have one name.
CsvTable read_csv(const std::filesystem::path& file);

/// With 17 digits, which preserve the bits. Throws Diagnostic (Fault::run) when the file cannot be written.
void write_csv(const CsvTable& table, const std::filesystem::path& file);

} // namespace kaya
