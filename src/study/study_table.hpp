// The table of a study: a row for each run.
#pragma once

#include "study/outcome.hpp"
#include "study/study.hpp"

#include <string>
#include <vector>

namespace kaya {

/// run, the parameters, the results, end, cycles, seconds, warnings, hash, message; weight when runs differ in it. Comma-separated
/// values with one header row; a cell that is not there is empty.
std::string csv_of(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                   const std::vector<Asked>& asked);

/// The same as HDF5: groups `parameters` and `results` with one column each, and run, end, cycles, seconds, warnings, weight next to them.
/// Booleans are 0 and 1, missing values are NaN; a column with texts is one text with a line for each run.
std::string hdf5_of(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                    const std::vector<Asked>& asked);

/// Columns for a terminal, of at most so many runs.
std::string table_text(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes,
                       const std::vector<Asked>& asked, std::size_t most);

} // namespace kaya
