// Measured orientations and sizes of fractures from a text.
#pragma once

#include "geometry/fractures/sample.hpp"

#include <string>
#include <string_view>

namespace kaya {

/// Lines of numbers with blanks, commas or semicolons between them: a dip and a dip direction in degrees; the same behind a number of the
/// plane; the same with a weight at the end, 1 if there is none. All lines have the same form. What stands behind # is a remark, and so
/// are lines that begin with a semicolon and a first line without numbers. Throws Diagnostic with the file and the line.
Sample<MeasuredPlane> read_planes(std::string_view text, const std::string& file);

/// The same with a diameter in place of dip and dip direction.
Sample<double> read_diameters(std::string_view text, const std::string& file);

} // namespace kaya
