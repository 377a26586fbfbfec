// Which blocks touch, and when to look again.
#pragma once

#include "joints/joint_model.hpp"
#include "model/model.hpp"

namespace kaya {

/// Looks at all pairs of blocks that are near each other and of which one has moved since it was looked
/// at last. `moving`: see replace_contacts.
void search_contacts(Model& model, JointRegistry& joints, bool moving);

/// Whether a block has gone so far that it may be about to touch another.
bool contacts_are_due(const Model& model);

/// Makes the geometry of contacts anew that have slid farther than their tolerance. Returns whether
/// any was.
bool refresh_slid_contacts(Model& model, JointRegistry& joints);

} // namespace kaya
