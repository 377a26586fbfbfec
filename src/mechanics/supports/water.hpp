// Water pressure in joints: docs/theory/loads.md, "Water in joints and zones".
// reads: sub_contacts.position, sub_contacts.load_arm, sub_contacts.area, gridpoints.pore_pressure, settings.water, water_ground
// writes: sub_contacts.pore_pressure, contacts.water_pressure, contacts.water_slope
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Gives each joint within which the water ends a pressure, linear over the joint (beside zones in addition to that of the places), so that it has the force and the moment of the
/// water on its wet part, where that is linear; others have none. Where contacts or the water have changed: cuts the common area of faces.
void find_ends_of_water(Model& model);

/// Writes the pressure at the places where the sub-contacts are now, where water acts.
void put_water(Model& model);

} // namespace kaya
