// Shear springs of overlap contacts: docs/theory/contacts.md, (10a) and (10b).
#pragma once

#include "mechanics/contact/carried_load.hpp"

namespace kaya {

/// Energy in the shear springs of the carriers (10a).
double shear_energy(const Model& model, Row contact);

void scale_shear(SubContacts& subs, Span rows, double scale);

/// Shear springs that keep their force hold more energy where their area has shrunk. It is paid from what growing areas have taken before, or
/// the force is reduced. `before`: the energy with the area before. Returns the energy lost.
double pay_for_area(Model& model, Row contact, double before);

/// The joint model has the area that carries the normal force, which follows every vibration; the shear springs have the shear area. Elastic
/// increments are those of the shear area. Where the joint model limits the force, stiffer springs take less of the displacement and leave
/// more to slip (10b).
void stiffen_shear(Model& model, Row contact, const CarriedLoad& before);

} // namespace kaya
