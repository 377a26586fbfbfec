// Advances cells whose six zones strain together: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Runs the zones of a tile of cells that strain together. Writes zones.stress or, if enabled, scratch.cells, zones.state, zones.history,
/// zones.warp, dashpots and the forces on the points of the tile. Throws Diagnostic when the zone model fails, or when a zone has no volume left.
ZoneSums run_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
                   std::vector<PointRow>& forces);

} // namespace kaya
