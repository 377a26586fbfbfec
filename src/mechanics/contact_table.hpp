// Filling the contact tables: new contacts, refreshed geometry, and what old sub-contacts hand on.
#pragma once

#include "joints/joint_model.hpp"
#include "mechanics/contact_geometry.hpp"
#include "model/model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// One row of the contact table to be.
struct ContactDraft {
    Row block1, block2;
    Row old = no_row;                      ///< the contact of the same blocks so far
    std::optional<TouchGeometry> geometry; ///< nothing: keep the old geometry
};

/// Replaces the contact tables by the drafts (sorted by block1, block2). A sub-contact of a refreshed
/// contact takes traction, displacement, history and state from the nearest old one of that contact.
/// Sub-contacts of new contacts are initialised by their joint model; `moving` says that what overlaps
/// already has been closed since the last search, so that the force of the overlap is taken up at once.
void replace_contacts(Model& model, JointRegistry& joints, std::vector<ContactDraft> drafts, bool moving);

/// Lets the joint models of the marked sub-contacts make their history agree with the forces and the gap
/// that are there.
void initialise_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked);

} // namespace kaya
