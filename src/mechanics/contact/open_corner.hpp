// Corners that show that an overlap cannot be a joint yet.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Every point of a joint that an overlap becomes is closed by this part of the depth: hysteresis for a joint that is about to open.
constexpr double least_closure = 0.03;

/// Whether a corner of one face of an overlap lies over the other face and is not closed: the faces cannot form a joint.
bool has_open_corner(const Model& model, Row contact);

} // namespace kaya
