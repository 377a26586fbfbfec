// Rigid blocks on corners and edges, or on a part of a joint: the normal force follows from their common volume. docs/theory/contacts.md,
// "Corners and edges".
#pragma once

#include "mechanics/contact/carried_load.hpp"
#include "mechanics/contact/contact_draft.hpp"
#include "mechanics/contact/contact_load.hpp"
#include "mechanics/contact/contact_work.hpp"
#include "laws/joint_model.hpp"

namespace kaya {

/// The beginning of an overlap contact's step.
struct OverlapStart {
    double lost = 0;   ///< energy of shear springs where the area changes
    bool lies = false; ///< the blocks touch with faces that are parallel, or nearly so
};

/// move_contact for overlap contacts: computes the present common volume and writes places, areas and increments of the sub-contacts. `slopes`
/// receives the integrals of a curved contact, and is empty for others.
OverlapStart move_overlap_contact(Model& model, Row contact, JointWork& work, OverlapScratch& scratch,
                                  OverlapSlopes* slopes);

/// Sets the offset of a contact so that its present overlap carries no force; no offset without overlap.
void begin_without_force(Model& model, Row contact, OverlapScratch& scratch);

/// The end of an overlap contact's step.
struct OverlapEnd {
    double lost =
        0; ///< energy: that of the springs of separated places, and energy taken that the contact does not return
    bool idle = false; ///< no force acts in it
};

/// Adds the work of the joint model's forces, and its dilation to the offset. A separated contact carries nothing.
OverlapEnd finish_overlap_contact(Model& model, Row contact, const CarriedLoad& before, const OverlapSlopes* slopes,
                                  JointWork& work);

/// Whether the sub-contacts of a joint are neither all closed nor all open, and none is in tension, or would be once it opens.
bool is_partly_open(const Model& model, const JointModel& joint, Row contact);

/// Turns a joint into an overlap contact; normal and shear force are kept. Returns the energy lost from its springs.
double follow_overlap(Model& model, const JointModel& joint, Row contact, OverlapScratch& scratch);

/// Pieces of two blocks have the overlap contact of these: leaves it the part that their own common volume carries.
void share_overlap(Model& model, const JointModel& joint, Row contact, OverlapScratch& scratch);

/// Turns an overlap contact into a joint: the normal force is distributed by the closure of each place and keeps its sum; shear force is
/// distributed in the same proportion. History comes from the overlap's first sub-contact, and the joint model makes it agree with the
/// forces. Open places, such as those of a block that gets zones, carry nothing and are marked in `moved`: their joint models must receive
/// their displacement increments, as must all places of a curved one. Throws Diagnostic when the joint model fails.
void close_joint(Model& model, const JointModel& joint, const ContactDraft& draft, Row c, const ContactLoad& before,
                 const ClosureOffset& offset, std::vector<char>& moved);

} // namespace kaya
