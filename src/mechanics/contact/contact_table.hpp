// Fills the contact tables: new contacts, updated geometry, and the data that old sub-contacts pass on.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/contact/contact_draft.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

struct OverlapScratch;

/// Builds the contact tables from drafts (sorted by block1, block2). A sub-contact with new geometry takes traction, displacement, history
/// and state from the nearest old one of its contact. Sub-contacts of new contacts are initialised by their joint model; `moving` says that
/// existing overlap was closed since the last search, so its force is applied at once. Where every row keeps its place the tables are
/// updated in place, and lists made from them stay valid if all blocks are rigid.
ContactChange replace_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                               bool moving, OverlapScratch& scratch);

/// The same for some of the contacts, if every row keeps its place; otherwise returns false and changes nothing. All drafts have an old
/// contact.
bool refresh_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                      OverlapScratch& scratch);

/// Runs the joint models of the marked sub-contacts for their displacement increments, which are then parts of their displacements.
void move_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked);

/// Lets the joint models of the marked sub-contacts make their history consistent with the present forces and gap.
void initialise_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked);

} // namespace kaya
