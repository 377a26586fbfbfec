// Plane polygons that a deck names: surfaces of `geometry`, discs of `fracture`. They are for cuts; save files do not hold them.
#pragma once

#include "base/vector.hpp"

#include <map>
#include <string>
#include <vector>

namespace kaya {

using PolygonSet = std::vector<std::vector<Vec3>>;

struct SurfaceSets {
    std::map<std::string, PolygonSet> surfaces, fractures; ///< by name in lower case
    std::string current;                                   ///< the set of the last `geometry set`; "": none yet
};

} // namespace kaya
