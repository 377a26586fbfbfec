// Rigid blocks that stand on corners and edges, or on a part of a joint: the normal force follows from the volume that
// they have in common. docs/theory/contacts.md, "Corners and edges".
#pragma once

#include "mechanics/contact_load.hpp"
#include "mechanics/contact_table.hpp"
#include "mechanics/overlap_patch.hpp"
#include "mechanics/move_contact.hpp"
#include "model/model.hpp"

namespace kaya {

/// Whether the contact's force follows from the overlap: not in small strain, where all places stay.
inline bool follows_overlap(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::overlap && model.settings.large_strain;
}

/// The part of move_contact for such contacts: finds the common part where the blocks are now and writes places, areas
/// and increments of the sub-contacts. Returns the energy of shear springs that is lost where the area changes.
double move_overlap_contact(Model& model, Row contact, JointWork& work, OverlapScratch& scratch);

/// Gives a contact the offset at which what overlaps carries nothing; none where nothing overlaps.
void begin_without_force(Model& model, Row contact, OverlapScratch& scratch);

/// Normal force and stiffness of the places that carry an overlap, and what friction has worn so far, before a joint model sees them.
struct CarriedLoad {
    double force = 0, stiffness = 0, worn = 0;

    CarriedLoad() = default;
    CarriedLoad(const Model& model, Row contact);
};

/// Adds the work of the forces that the joint model has given, and what it has dilated to the offset. A contact that has
/// parted carries nothing. Returns the energy that is lost: of the springs of what has parted, and what the contact has taken
/// and does not give back.
double finish_overlap_contact(Model& model, Row contact, const CarriedLoad& before, JointWork& work);

/// Work that the forces of a contact between rigid blocks, as they are, would do on the motion of the step.
double work_of_step(const Model& model, Row contact);

/// What friction has worn so far in a contact, as its joint model says.
double frictional_work(const Model& model, Row contact);

/// Whether the sub-contacts of a joint with fixed places are neither all closed nor all open, and none pulls.
bool is_partly_open(const Model& model, Row contact);

/// Makes an overlap contact of a joint with fixed places; normal and shear force stay. Returns the energy of its springs
/// that is lost.
double follow_overlap(Model& model, Row contact, OverlapScratch& scratch);

/// Makes a joint of an overlap: normal force by the closure of each place, in all what it was; shear force in the same parts. Places that
/// are open, as those of a block that gets zones may be, carry nothing and are marked in `moved`: their joint models must be told of their
/// displacement increments. `first` is the row of the first place; history comes from the overlap's first sub-contact.
void close_joint(Model& model, const ContactDraft& draft, Row c, Row first, const ContactLoad& before,
                 const ClosureOffset& offset, std::vector<char>& moved);

} // namespace kaya
