// The stress that the motion of cells has made, where it is not the one that they have: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zone_laws.hpp"

namespace kaya {

/// Whether cells keep it apart, in a column of Zones::history with component k in zone k of the cell.
inline bool keeps_cell_motion(const Zones& zones, const ZoneLaw& law) {
    return static_cast<std::size_t>(zones.history_columns) > law.cell_history + 2;
}
/// That of the cells from one on; null where it is the stress that they have.
inline double* cell_motion(Zones& zones, const ZoneLaw& law, Row first) {
    return keeps_cell_motion(zones, law) ? &zones.history[law.cell_history + 2][first] : nullptr;
}
inline const double* cell_motion(const Zones& zones, const ZoneLaw& law, Row first) {
    return keeps_cell_motion(zones, law) ? &zones.history[law.cell_history + 2][first] : nullptr;
}

/// Where zones of a cell have stresses of their own: from now on motion makes a stress besides, which is nothing yet.
void part_cell_motion(Model& model, const ZoneLaws& laws);

/// From now on the stress that motion has made so far stays. Without room for it, it is the one that the cells have.
void keep_cell_motion(Model& model, const ZoneLaws& laws);

/// Zones have got another stress than that of their motion.
void forget_cell_motion(Model& model, ZoneModels& models, const std::vector<Row>& zones);

/// A part of all stresses of zones is taken away.
void scale_zone_stresses(Model& model, const ZoneLaws& laws, double factor);

} // namespace kaya
