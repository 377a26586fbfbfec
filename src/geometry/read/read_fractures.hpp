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
    traces,   ///< both ends x, y, z, and the dip and dip direction of the fracture; without them it is upright
    fracman   ///< sections with numbered corners of polygons, as text with the suffix .fab: read_fracman
};

/// Lines of numbers with blanks, commas or semicolons between them. What stands behind # is a remark; so is a first line without numbers.
/// A trace is a diameter of its disc. Throws Diagnostic with the file and the line.
std::vector<Fracture> read_fractures(std::string_view text, const std::string& file, FractureFormat format);

/// The polygons in the section FRACTURE of a text of sections BEGIN NAME ... END NAME. A line has the number of a fracture, that of its
/// corners, and its set; lines with a number and x, y, z of each corner follow, and one with 0 and the normal. Corners that are off their
/// plane by less than a thousandth of the polygon's size, because they are rounded, are put into it. The set becomes a group of the slot
/// `set`. Throws Diagnostic with the file and the line.
std::vector<Fracture> read_fracman(std::string_view text, const std::string& file);

} // namespace kaya
