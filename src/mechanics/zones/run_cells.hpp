// Advances cells whose six zones strain together: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Whether the zones of a cell strain together: only where damping removes the motion, so only its end state counts.
bool cells_go_together(const Settings& settings);

/// Runs the zones of a tile of cells that strain together. Writes zones.stress or, if enabled, scratch.cells, zones.state, zones.history
/// and the forces on the points of the tile. Throws Diagnostic when the zone model fails, or when a zone has no volume left.
ZoneSums run_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
                   std::vector<PointRow>& forces);

/// Forces of cells, including flowing ones, from the present stresses, without a step.
void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces);

/// For cells whose zones strain separately: warp stresses and stresses of motion are kept. Adds their forces and returns the work of the
/// motion against them.
double hold_cells(Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law, TileForces& forces);

/// The same forces without a step.
void held_forces(const Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law,
                 TileForces& forces);

} // namespace kaya
