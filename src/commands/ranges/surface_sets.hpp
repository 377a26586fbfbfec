// Names of a deck for cuts: surfaces of `geometry` from plane polygons, networks of `fracture` from discs, and laws to draw discs from.
#pragma once

#include "base/vector.hpp"
#include "geometry/fractures/fracture_law.hpp"

#include <map>
#include <string>
#include <vector>

namespace kaya {

using PolygonSet = std::vector<std::vector<Vec3>>;

struct SurfaceSets {
    std::map<std::string, PolygonSet> surfaces; ///< by name in lower case, as all of them
    std::string current;                        ///< the set of the last `geometry set`; "": none yet
    std::map<std::string, std::vector<Disc>> networks;
    std::map<std::string, FractureLaw> laws;
    std::string last_law; ///< that was made; "": none yet

    bool empty() const { return surfaces.empty() && networks.empty() && laws.empty() && current.empty(); }
};

/// A text for save files; numbers keep all their bits.
std::string surfaces_text(const SurfaceSets& sets);

/// Throws Diagnostic when the text is truncated or malformed.
SurfaceSets surfaces_from_text(const std::string& text);

} // namespace kaya
