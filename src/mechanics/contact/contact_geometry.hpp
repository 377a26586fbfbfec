// Finds the contact of two blocks: the common plane and the points where force acts.
#pragma once

#include "mechanics/contact/contact_plane.hpp"
#include "mechanics/contact/fine_places.hpp"
#include "mechanics/shape/surfaces.hpp"

namespace kaya {

struct SearchScratch;

/// Faces with a narrower common area do not form a contact.
double narrowest_contact(const Model& model, Row block1, Row block2);

/// The contact of two blocks whose surfaces are nearer than `margin`; none when they are farther apart or share only an edge or corner of
/// parallel faces, without area. Returns whether there is one; if not, points may be left in the list. Two rigid blocks share a joint where
/// their faces are parallel, or an overlap; the points of an overlap are not filled in. `old` is their present contact, if any;
/// `fine`: how near the sub-contacts of a joint between rigid blocks are.
bool find_geometry(const Model& model, const Surfaces& surfaces, Row block1, Row block2, Row old, FinePlaces fine,
                   double margin, ContactGeometry& geometry, SearchScratch& scratch);

} // namespace kaya
