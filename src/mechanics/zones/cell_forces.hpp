// Forces of cells on their corners: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/cell_layers.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <vector>

namespace kaya {

/// Whether any of these cells has an initial stress.
bool has_initial(const Zones& zones, Row zone, Row cells);

/// Forces of the initial stresses of cells at the end of a step, and their work in it.
struct InitialForces {
    CellForces forces;
    Eight work;

    /// `shape` and `place` at the end of the step, `strain` and `volume` in its middle. `outer`: bits of the cells, see ZoneTiles.
    InitialForces(const Model& model, const CellShape& shape, const CellField& place, const CellField& shift,
                  const SixZones& initial, const SixEights& strain, const Eight& volume, const std::uint8_t* outer);
};

/// Forces of cells from the present stresses, without a step.
void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces);

} // namespace kaya
