// Stresses that are stored for cells, and their changes when a zone model or a stress is set: docs/theory/zones.md, "Cells".
#pragma once

#include "mechanics/zones/zone_laws.hpp"

namespace kaya {

/// After stresses of zones were set: where those of a cell differ, they are its initial stress.
void note_initial_stress(Model& model, const std::vector<Row>& zones);

/// Moves the stresses of layers into the zones of cells whose zones flow, and out of those whose zones strain together.
void settle_cells(Model& model, const ZoneLaws& laws);

/// Scales all zone stresses.
void scale_zone_stresses(Model& model, double factor);

/// Gives each corner of a cell an eighth of its mass, in place of what its zones give.
void share_masses(Model& model, const ZoneLaws& laws);

} // namespace kaya
