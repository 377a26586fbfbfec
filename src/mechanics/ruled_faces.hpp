// Faces that two elastic cells share, which are ruled surfaces: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/ties.hpp"
#include "mechanics/zone_laws.hpp"

namespace kaya {

/// Fills ZoneTiles::ruled: the faces of cells whose four corners are those of another cell as well, in the same block or tied exactly.
void find_ruled_faces(const Model& model, const TieLists& ties, ZoneLaws& laws);

} // namespace kaya
