// The surface around convex parts that lie against each other.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"
#include "geometry/surface/surface.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// The faces of the parts without what other parts cover, outward. Corners of one part on edges of another are corners of both. None when
/// the surface is not closed, because faces lie against each other farther apart than 1e-5 of the size.
std::optional<Surface> outer_surface(const std::vector<Polyhedron>& parts);

} // namespace kaya
