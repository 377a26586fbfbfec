// The stress made by the motion of cells, where it differs from their total stress: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/zone_laws.hpp"

namespace kaya {

/// The stress of motion of the cells starting at `first`; null where it equals their total stress.
inline double* cell_motion(Zones& zones, Row first) {
    return zones.keeps_cell_motion ? &zones.cell_motion[first] : nullptr;
}
inline const double* cell_motion(const Zones& zones, Row first) {
    return zones.keeps_cell_motion ? &zones.cell_motion[first] : nullptr;
}

/// For cells whose zones have different stresses: starts a separate stress of motion at zero.
void part_cell_motion(Model& model, const ZoneLaws& laws);

/// Resets the stress of motion of zones whose stress was set.
void forget_cell_motion(Model& model, const std::vector<Row>& zones);

/// Scales all zone stresses.
void scale_zone_stresses(Model& model, double factor);

/// Gives each corner of cells whose zones strain together an eighth of the cell's mass, in place of what its zones give.
void share_masses(Model& model, const ZoneLaws& laws);

/// Moves what earlier versions kept of elastic cells in columns of their zone model's history.
void take_cells_from_history(Model& model, const ZoneLaws& laws);

} // namespace kaya
