// Which rule gives the force of a contact.
#pragma once

#include "mechanics/shape/rigid_pair.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Whether the contact's force follows from the overlap; never in small strain, where places are fixed.
inline bool follows_overlap(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::overlap && model.settings.large_strain;
}

/// Whether a contact moves as a joint between rigid blocks does.
inline bool is_rigid_joint(const Model& model, Row contact) {
    return between_rigid(model, contact) && !follows_overlap(model, contact);
}

} // namespace kaya
