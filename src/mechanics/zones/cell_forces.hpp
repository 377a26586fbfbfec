// Forces of cells on their corners: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/cell_layers.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Whether any of these cells has an initial stress.
bool has_initial(const Zones& zones, Row zone, Row cells);

/// Forces of the initial stresses of cells, which balance the weights of their zones.
CellForces initial_forces(const Model& model, const CellField& place, const SixZones& initial);

/// The work of these forces in a step whose strain and volume are those of its middle, and whose end has this shape.
Eight work_of_initial(const CellForces& forces, const SixZones& initial, const CellShape& shape, const CellField& shift,
                      const SixEights& strain, const Eight& volume);

/// Forces of cells from the present stresses, without a step.
void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces);

} // namespace kaya
