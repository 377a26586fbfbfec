// Sub-contacts of two faces, one or both of zones: docs/theory/contacts.md, "Face to face: the overlay".
#pragma once

#include "mechanics/contact/contact_plane.hpp"
#include "mechanics/shape/surfaces.hpp"

namespace kaya {

struct SearchScratch;

/// How the overlay of two faces is made.
struct FaceOverlay {
    double cosine;    ///< of the angle between the faces
    double margin;    ///< they are a contact when a point is nearer
    double tolerance; ///< points that are closer coincide
    double edge;      ///< length of the edges of its triangles, 0: as they are
};

/// Sub-contacts at the vertices of the overlay of the two faces of `geometry`. False: they do not touch.
bool intersect_faces(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, const FaceOverlay& made,
                     SearchScratch& scratch);

} // namespace kaya
