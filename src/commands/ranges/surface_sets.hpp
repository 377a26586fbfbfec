// Plane polygons that a deck names: surfaces of `geometry`, discs of `fracture`. They are for cuts.
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

    bool empty() const { return surfaces.empty() && fractures.empty() && current.empty(); }
};

/// A text for save files; numbers keep all their bits.
std::string surfaces_text(const SurfaceSets& sets);

/// Throws Diagnostic when the text is truncated or malformed.
SurfaceSets surfaces_from_text(const std::string& text);

} // namespace kaya
