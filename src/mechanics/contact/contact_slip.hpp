// How far a contact has slipped since its geometry was updated, and how finely friction has to be summed where its blocks turn.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// The farthest distance of both sides of a place in the plane of the contact, a length.
double slip_of(const Model& model, Row contact);

/// Whether a joint slides and turns about a centre near its face. Friction acts against the slip of each place, and eight places miss its sum
/// then: docs/theory/contacts.md, "Sliding and new geometry".
bool turns_as_it_slides(const Model& model, Row contact);

} // namespace kaya
