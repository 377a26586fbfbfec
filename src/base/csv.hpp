// Tables as comma-separated values.
#pragma once

#include <string>
#include <string_view>

namespace kaya {

/// One cell. RFC 4180: quoted if it contains a separator, with quotes doubled. A text that a spreadsheet takes for a formula gets an apostrophe in
/// front; a number does not.
std::string csv_cell(std::string_view text);

/// A number with the fewest digits that preserve the bits; an empty cell for NaN.
std::string csv_cell(double number);

} // namespace kaya
