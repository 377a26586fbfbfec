// Corners and edges of blocks with zones in contact where neither a vertex lies over a face nor edges cross.
#pragma once

#include "mechanics/contact_geometry.hpp"

namespace kaya {

struct OverlapScratch;

/// The place where two convex blocks are deepest in each other, or are first if they come nearer along the normal of
/// `geometry` by `distance`; of blocks that would miss each other that way, the places that are nearest: one point, without its
/// area. False where there is none.
bool find_corner_contact(const Model& model, const Surfaces& surfaces, Row block1, Row block2, double distance,
                         ContactGeometry& geometry, OverlapScratch& scratch);

} // namespace kaya
