// Which rule gives the force of a contact.
#pragma once

#include "model/measure/overlap_rows.hpp"

namespace kaya {

/// Whether a contact moves as a joint between rigid blocks does.
inline bool is_rigid_joint(const Model& model, Row contact) {
    return between_rigid(model, contact) && !follows_overlap(model, contact);
}

} // namespace kaya
