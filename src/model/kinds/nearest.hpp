// The object that is nearest to a place, for scripts and histories.
#pragma once

#include "model/kinds/selection.hpp"

namespace kaya {

/// From the place to the nearest point of a block, face or zone, 0 inside of it; to the position of a gridpoint, contact or
/// sub-contact.
double distance_to(const Model& model, ObjectKind kind, Row row, const Vec3& place);

/// The row with the least distance_to; among equals, where blocks are in contact, the one whose reference point is nearest. no_row when
/// there is none.
Row nearest_row(const Model& model, ObjectKind kind, const Vec3& place);

/// Diagonal of the box around a block.
double block_size(const Model& model, Row block);

} // namespace kaya
