// Advances cells whose zones flow: docs/theory/zones.md, "Six points".
#pragma once

#include "mechanics/common/phase_sums.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Runs the zones of a tile of cells, each at the middle of a face of its cell. Writes zones.stress, zones.initial, zones.state, zones.history,
/// zones.warp, dashpots and the forces on the points of the tile. Throws Diagnostic when the zone model fails, or when
/// a zone has no volume left.
ZoneSums run_flowing_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                           const std::vector<double>& pressure, std::vector<PointRow>& forces);

} // namespace kaya
