// Names of a deck for cuts: surfaces of `geometry` from plane polygons, networks of `fracture`, and laws to draw fractures from.
#pragma once

#include "base/vector.hpp"
#include "geometry/fractures/fracture.hpp"
#include "geometry/fractures/fracture_law.hpp"

#include <map>
#include <string>
#include <vector>

namespace kaya {

using PolygonSet = std::vector<std::vector<Vec3>>;

using Network = std::vector<Fracture>;

struct SurfaceSets {
    std::map<std::string, PolygonSet> surfaces; ///< by name in lower case, as all of them
    std::string current;                        ///< the set of the last `geometry set`; "": none yet
    std::map<std::string, Network> networks;
    std::int64_t next_fracture = 1; ///< id of the next fracture
    std::map<std::string, FractureLaw> laws;
    std::string last_law; ///< that was made; "": none yet

    bool empty() const { return surfaces.empty() && networks.empty() && laws.empty() && current.empty(); }
};

/// Adds a fracture to a network, which it makes if there is none of that name, and gives it its id.
Fracture& add_fracture(SurfaceSets& sets, const std::string& network, Fracture fracture);

/// A text for save files; numbers keep all their bits.
std::string surfaces_text(const SurfaceSets& sets);

/// Throws Diagnostic when the text is truncated or malformed.
SurfaceSets surfaces_from_text(const std::string& text);

} // namespace kaya
