// Histories as a table of comma-separated values.
#pragma once

#include "base/units.hpp"
#include "model/tables/model.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// The text: one header row that names each column, then a row per sample. Numbers are written with
/// the fewest digits that preserve the bits. The first columns are cycle and time, or the
/// history `versus` when it is given. A sample that a history does not have is an empty cell.
/// No numbers: all histories. Throws Diagnostic for a number that is not there.
std::string history_csv(const Histories& histories, const std::vector<std::int64_t>& numbers,
                        std::optional<std::int64_t> versus, const Units& units = {});

/// The same to a file, whole or not at all (base/whole_file.hpp).
void write_history_csv(const Histories& histories, const std::string& path, const std::vector<std::int64_t>& numbers,
                       std::optional<std::int64_t> versus, const Units& units = {});

/// The header of a history's column: number, label and place: "3:Normal Stress [script nstav]", "6:shear_displacement [length, sub-contact
/// nearest to -1 -1 0]".
std::string column_title(const History& history);

} // namespace kaya
