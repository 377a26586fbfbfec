// Corners and edges of blocks with zones in contact where neither a vertex lies over a face nor edges cross.
#pragma once

#include "mechanics/contact/contact_plane.hpp"
#include "mechanics/shape/surfaces.hpp"

namespace kaya {

struct OverlapScratch;

/// The point where two convex blocks overlap most, or meet first when they approach along the normal of `geometry` by `distance`; for
/// blocks that would miss each other, the nearest points: one point, without its area. False where there is none.
bool find_corner_contact(const Model& model, const Surfaces& surfaces, Row block1, Row block2, double distance,
                         ContactGeometry& geometry, OverlapScratch& scratch);

} // namespace kaya
