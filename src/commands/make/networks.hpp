// Networks of fractures by name.
#pragma once

#include "base/diagnostic.hpp"
#include "commands/ranges/surface_sets.hpp"

namespace kaya {

/// Throws Diagnostic at the place when there is none of that name, which is in lower case.
const std::vector<Disc>& network_named(const SurfaceSets& sets, const std::string& name, const Place& place);

} // namespace kaya
