// Faces shared by two cells, which are ruled surfaces: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/ties/ties.hpp"
#include "mechanics/zones/zone_laws.hpp"

namespace kaya {

/// Fills ZoneTiles::ruled: faces of cells whose four corners also belong to another cell, in the same block or tied exactly.
void find_ruled_faces(const Model& model, const TieLists& ties, ZoneLaws& laws);

} // namespace kaya
