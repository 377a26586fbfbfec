// Cells whose six zones go together, one step on: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/run_zone_models.hpp"
#include "mechanics/tile_rows.hpp"
#include "mechanics/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Whether the zones of a cell strain together: where damping takes the motion away, so that only where it ends counts.
bool cells_go_together(const Settings& settings);

/// The zones of a tile, all in cells that go together. Writes zones.stress or where it is wanted scratch.cells, zones.state, zones.history
/// and the forces on the points of the tile. Throws Diagnostic when the zone model fails, or when a zone has no volume left.
ZoneSums run_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
                   std::vector<PointRow>& forces);

/// Forces of cells, flowing ones as well, with the stresses that are there, without a step.
void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces);

/// Where the zones of cells go on their own: what cells resist warping with and the stress that their motion has made stay as they are.
/// Adds their forces, and returns the work that the motion does against them.
double hold_cells(Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law, TileForces& forces);

/// The same forces without a step.
void held_forces(const Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law,
                 TileForces& forces);

} // namespace kaya
