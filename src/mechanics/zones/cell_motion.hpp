// The stress made by the motion of cells, where it differs from their total stress: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/zone_laws.hpp"

namespace kaya {

/// Whether cells keep it separately, in a column of Zones::history with component k in zone k of the cell.
inline bool keeps_cell_motion(const Zones& zones, const ZoneLaw& law) {
    return static_cast<std::size_t>(zones.history_columns) > law.cell_history + 2;
}
/// The stress of motion of the cells starting at `first`; null where it equals their total stress.
inline double* cell_motion(Zones& zones, const ZoneLaw& law, Row first) {
    return keeps_cell_motion(zones, law) ? &zones.history[law.cell_history + 2][first] : nullptr;
}
inline const double* cell_motion(const Zones& zones, const ZoneLaw& law, Row first) {
    return keeps_cell_motion(zones, law) ? &zones.history[law.cell_history + 2][first] : nullptr;
}

/// For cells whose zones have different stresses: starts a separate stress of motion at zero.
void part_cell_motion(Model& model, const ZoneLaws& laws);

/// Keeps the stress of motion from here on. Without a column for it, the total stress of the cells is used.
void keep_cell_motion(Model& model, const ZoneLaws& laws);

/// Resets the stress of motion of zones whose stress was set.
void forget_cell_motion(Model& model, ZoneModels& models, const std::vector<Row>& zones);

/// Scales all zone stresses.
void scale_zone_stresses(Model& model, const ZoneLaws& laws, double factor);

} // namespace kaya
