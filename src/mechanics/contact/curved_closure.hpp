// Overlaps whose joint model is curved: its stiffness depends on the closure. docs/theory/contacts.md, (10c) to (10f).
#pragma once

#include "mechanics/contact/batches.hpp"
#include "mechanics/contact/carried_load.hpp"
#include "mechanics/shape/overlap_scratch.hpp"

#include <span>

namespace kaya {

/// Changes a patch to what a curved joint model sees: the mean closure, and the area, place and direction of its force. `part`: the mean
/// stress on the way to that closure over the present stress, a half for straight springs.
void press(OverlapPatch& patch, const OverlapSlopes& slopes, double part);

/// That part at a closure, as far as the present stiffness shows.
double foreseen_part(const Model& model, Row contact, double closure);

/// After the joint model has run: adds the step to the energy density and gives the carriers the force, area and places that follow from it.
/// `dilation` is closure that the joint model has added.
void settle_curved(Model& model, Row contact, const OverlapSlopes& slopes, const CarriedLoad& before, double dilation);

/// The state of a place of a joint, by closure and stress.
struct ClosedPlace {
    double closure = 0, stress = 0;
};

/// The start of an overlap whose carriers have the state of a place of the former joint: the joint model is run to the mean closure. Throws
/// Diagnostic when it fails.
void begin_curved(Model& model, const JointModel& joint, Row contact, const OverlapSlopes& slopes,
                  const ClosedPlace& from);

/// Marks the contacts of curved joint models. An overlap that carries a force keeps it when its joint model has become a curved one; one
/// that is no more curved sees the mean closure until it opens.
void note_curved(Model& model, const std::vector<Batch>& batches);

/// A place of the joint that an overlap may become.
struct PlaceAhead {
    double area, closure;
};

/// Whether that joint would have the volume, the force and the energy of the overlap.
bool closes_alike(const Model& model, const JointModel& joint, Row contact, std::span<const PlaceAhead> places);

/// What the normal springs of a joint return when each of its rows opens.
double energy_of_rows(const Model& model, const JointModel& joint, Row contact);

} // namespace kaya
