// How far a contact has slipped since its geometry was updated, and how finely friction has to be summed where its blocks turn.
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// The farthest distance of both sides of a place in the plane of the contact, a length.
double slip_of(const Model& model, Row contact);

/// The distance of sub-contacts that a joint between two rigid blocks needs by its slip, a length; 0: none. Friction acts against the slip of
/// each place: where blocks slide and the centre of their turn is near the face, eight places miss its sum (docs/theory/contacts.md,
/// "Sliding and new geometry").
double spacing_of_slip(const Model& model, Row contact);

} // namespace kaya
