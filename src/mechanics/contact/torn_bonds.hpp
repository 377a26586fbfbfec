// Bonds of joints of rigid blocks that open in part: a place that has been open has no bond when the joint closes again.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// A joint is about to become an overlap: notes the places that carry nothing, if its model has a bond. Of earlier ones it keeps those that are
/// closed and whose state says that something has happened to them.
void begin_tearing(Model& model, const JointModel& joint, Row contact);

/// The joint has become an overlap: notes the places of the joint that are open now.
void note_torn(Model& model, Row contact);

/// The loaded row that speaks for the closed part of a joint: the one with the greatest traction of those with a bond or of those that are torn,
/// whichever have more area. `most` is that of all rows.
Row row_of_majority(const Model& model, Row contact, Row most);

/// Shows the joint model of a joint that has closed an opening of its torn places, far enough to break any bond. Forces, displacements and work
/// of these rows remain as they are; the history of the model changes. Throws Diagnostic when the model fails.
void tear(Model& model, const JointModel& joint, Row contact);

} // namespace kaya
