// Fractures as a text that read_fractures reads.
#pragma once

#include "geometry/read/read_fractures.hpp"

namespace kaya {

/// With all digits. Polygons and fracman have the corners of a polygon with `sides` sides and the same area for a disc; the sets of fracman
/// are the groups of the slot `set`. Throws Diagnostic when a polygon is to be written as a disc; `format` is not traces.
std::string fractures_text(const std::vector<Fracture>& fractures, FractureFormat format, int sides);

} // namespace kaya
