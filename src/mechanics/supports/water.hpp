// Water pressure in joints: docs/theory/contacts.md.
// reads: sub_contacts.position, gridpoints.pore_pressure, settings.water, water_ground
// writes: sub_contacts.pore_pressure
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Writes the pressure at the places where the sub-contacts are now, where water acts.
void put_water(Model& model);

} // namespace kaya
