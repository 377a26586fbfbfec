// Which rule gives the force of a contact.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Whether the contact's force follows from the overlap; never in small strain, where places are fixed.
inline bool follows_overlap(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::overlap && model.settings.large_strain;
}

} // namespace kaya
