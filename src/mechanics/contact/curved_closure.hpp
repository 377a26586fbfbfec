// Overlaps whose joint model is curved: its stiffness depends on the closure. docs/theory/contacts.md, (10c) to (10f).
#pragma once

#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/carried_load.hpp"
#include "mechanics/contact/closed_halves.hpp"
#include "mechanics/shape/overlap_scratch.hpp"

#include <span>

namespace kaya {

/// Changes the patch of a contact to what its joint model will see, as far as the present stiffnesses show: its force over its mean stress as an
/// area, and the place and direction of that force. Returns the closures of the carriers.
CarrierRows press(const Model& model, Row contact, OverlapPatch& patch, const OverlapSlopes& slopes);

/// Whether a sub-contact is in tension once it has opened by a distance: its joint model has a bond. The sub-contact stays as it is.
bool holds_when_opened(const Model& model, const JointModel& joint, Row sub_contact, double by);

/// Finds what a joint model leaves of the shear forces of the carriers in a step without shear motion. Its normal displacement increments must be known.
void hold_shear(const Model& model, const JointModel& joint, Row contact, CarriedLoad& load);

/// After the joint model has run: adds the step to the energies of both halves, and the dilation of the joint model to the offset, and gives
/// the carriers the force, area and places that follow. `before` is what they carried; `slips`: the joint model has done frictional work.
void settle_curved(Model& model, Row contact, const OverlapSlopes& slopes, const CarriedLoad& before, bool slips);

/// The state of a place of a joint, by closure and stress.
struct ClosedPlace {
    double closure = 0, stress = 0;
};

/// The exponent m of a stress ~ closure^m that has this stiffness there.
double power_at(const ClosedPlace& place, double stiffness);

/// The start of an overlap whose carriers have the state of a place of the former joint: the joint model is run to the closures of the
/// halves. Throws Diagnostic when it fails.
void begin_curved(Model& model, const JointModel& joint, Row contact, const OverlapSlopes& slopes,
                  const ClosedPlace& from);

/// Runs the joint model from the state of each carrier to the closure of its half, with the force and energy that follow. Throws Diagnostic when
/// it fails.
void close_halves(Model& model, const JointModel& joint, Row contact, const OverlapSlopes& slopes);

/// Marks the contacts of curved joint models. An overlap that carries a force keeps it when its joint model has become a curved one; one
/// that is no more curved has two halves until it opens.
void note_curved(Model& model, const std::vector<Batch>& batches);

/// A place of the joint that an overlap may become.
struct PlaceAhead {
    double area, closure;
};

/// Whether that joint would have the volume, the force and the energy of the overlap.
bool closes_alike(const Model& model, const JointModel& joint, Row contact, std::span<const PlaceAhead> places);

/// The energy that the normal springs of a joint release while each of its rows opens.
double energy_of_rows(const Model& model, const JointModel& joint, Row contact);

} // namespace kaya
