// Filling the contact tables: new contacts, refreshed geometry, and what old sub-contacts hand on.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/contact_geometry.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace kaya {

struct OverlapScratch;

enum class DraftKind : std::uint8_t {
    as_it_was,
    new_geometry,
    overlap ///< of rigid blocks: one that is new, or made of a joint between them
};

/// One row of the contact table to be.
struct ContactDraft {
    Row block1, block2;
    Row old = no_row; ///< the contact of the same blocks so far
    DraftKind kind = DraftKind::as_it_was;
    ContactPlane plane;                     ///< when it is new
    std::span<const ContactPoint> points{}; ///< also then; they belong to someone else
};

/// What became of the contact tables.
enum class ContactChange { none, refreshed, replaced };

/// Makes the contact tables from drafts (sorted by block1, block2). A sub-contact of a contact
/// with new geometry takes traction, displacement, history and state from the nearest old one of that contact.
/// Sub-contacts of new contacts are initialised by their joint model; `moving` says that what overlaps
/// already has been closed since the last search, so that the force of the overlap is taken up at once.
/// Where every row keeps its place the tables are refreshed, and lists made of them hold on if all blocks are rigid.
ContactChange replace_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                               bool moving, OverlapScratch& scratch);

/// The same for a part of the contacts, if every row keeps its place; otherwise it does nothing and returns false.
/// All drafts have an old contact.
bool refresh_contacts(Model& model, JointRegistry& joints, const std::vector<ContactDraft>& drafts,
                      OverlapScratch& scratch);

/// Lets the joint models of the marked sub-contacts make their history agree with the forces and the gap
/// that are there.
void initialise_sub_contacts(Model& model, JointRegistry& joints, const std::vector<char>& marked);

} // namespace kaya
