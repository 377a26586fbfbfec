// Discs of a network of fractures from a text.
#pragma once

#include "geometry/fractures/disc.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Lines of x, y, z, dip, dip direction and diameter, with blanks, commas or semicolons between them. What stands behind # is a remark; so
/// is a first line without numbers. Throws Diagnostic with the file and the line.
std::vector<Disc> read_discs(std::string_view text, const std::string& file);

} // namespace kaya
