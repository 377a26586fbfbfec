// Shear springs of overlap contacts: docs/theory/contacts.md, (10a) and (10b).
#pragma once

#include "mechanics/contact/carried_load.hpp"
#include "mechanics/contact/closed_halves.hpp"
#include "mechanics/contact/contact_work.hpp"

namespace kaya {

/// Where the shear forces of an overlap act.
inline Eight3 shear_places(const SubContacts& subs, Row row, const RowsOfEight& group) {
    return group.load(subs.position, row) + group.load(subs.shear_arm, row);
}

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

/// A contact whose area collapses in a step, such as one of faces that vibrate, has more shear force than friction can hold on what is left: it
/// slips on its springs. The joint model would slip on that area's, which are far softer. `rows` are those after the collapse.
void hold_by_grip(Model& model, Row contact, const CarrierRows& rows);

/// Which carriers the joint model has let slip in this step.
using SlippedCarriers = std::array<bool, carriers>;
SlippedCarriers slipped_carriers(const Model& model, Row contact, const CarriedLoad& before);

/// Shear forces act at fixed places until they slip; then they go to those of the pressure. Returns the energy lost, see turn_shear.
double release_places(Model& model, Row contact, const SlippedCarriers& slipped);

} // namespace kaya
