// Fractures from a text.
#pragma once

#include "geometry/fractures/fracture.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// What lines of a file of fractures are.
enum class FractureFormat {
    discs,    ///< x, y, z, dip, dip direction and diameter
    polygons, ///< corners x, y, z; an empty line, or one without numbers, ends a polygon
    traces    ///< both ends x, y, z, and the dip and dip direction of the fracture; without them it is upright
};

/// Lines of numbers with blanks, commas or semicolons between them. What stands behind # is a remark; so is a first line without numbers.
/// A trace is a diameter of its disc. Throws Diagnostic with the file and the line.
std::vector<Fracture> read_fractures(std::string_view text, const std::string& file, FractureFormat format);

} // namespace kaya
