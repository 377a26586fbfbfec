// Rigid blocks on corners and edges, or on a part of a joint: the normal force follows from their common volume. docs/theory/contacts.md,
// "Corners and edges".
#pragma once

#include "mechanics/contact_load.hpp"
#include "mechanics/contact_table.hpp"
#include "mechanics/overlap_patch.hpp"
#include "mechanics/move_contact.hpp"
#include "model/model.hpp"

namespace kaya {

/// Whether the contact's force follows from the overlap; never in small strain, where places are fixed.
inline bool follows_overlap(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::overlap && model.settings.large_strain;
}

/// move_contact for overlap contacts: computes the present common volume and writes places, areas and increments of the sub-contacts.
/// Returns the energy lost from shear springs where the area changes.
double move_overlap_contact(Model& model, Row contact, JointWork& work, OverlapScratch& scratch);

/// Sets the offset of a contact so that its present overlap carries no force; no offset without overlap.
void begin_without_force(Model& model, Row contact, OverlapScratch& scratch);

/// Normal force, stiffness, frictional work and shear forces of the carriers of an overlap before a joint model sees them.
struct CarriedLoad {
    double force = 0, stiffness = 0, worn = 0;
    std::array<Vec3, carriers> shear;
    std::array<double, carriers> worn_by_row{};

    CarriedLoad() { shear.fill(Vec3::Zero()); }
    CarriedLoad(const Model& model, Row contact);
};

/// Adds the work of the joint model's forces, and its dilation to the offset. A separated contact carries nothing. Returns the energy lost:
/// that of the springs of separated places, and energy taken that the contact does not return.
double finish_overlap_contact(Model& model, Row contact, const CarriedLoad& before, JointWork& work);

/// Work of the present forces of a contact between rigid blocks on the motion of the step.
double work_of_step(const Model& model, Row contact);

/// Accumulated frictional work of a contact according to its joint model.
double frictional_work(const Model& model, Row contact);

/// Whether the sub-contacts of a joint are neither all closed nor all open, and none is in tension.
bool is_partly_open(const Model& model, Row contact);

/// Turns a joint into an overlap contact; normal and shear force are kept. Returns the energy lost from its springs.
double follow_overlap(Model& model, Row contact, OverlapScratch& scratch);

/// Turns an overlap contact into a joint: the normal force is distributed by the closure of each place and keeps its sum; shear force is
/// distributed in the same proportion. Open places, such as those of a block that gets zones, carry nothing and are marked in `moved`:
/// their joint models must receive their displacement increments. `first` is the row of the first place; history comes from the overlap's
/// first sub-contact.
void close_joint(Model& model, const ContactDraft& draft, Row c, Row first, const ContactLoad& before,
                 const ClosureOffset& offset, std::vector<char>& moved);

} // namespace kaya
