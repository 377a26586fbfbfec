// How far the two sides of a joint are apart: docs/theory/contacts.md.
#pragma once

#include "model/measure/overlap_rows.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Current position of one side of a sub-contact.
inline Vec3 attached_position(const Model& model, const Attachment& side) {
    const auto& x = model.gridpoints.position;
    if (side.weights[0] == 1) return x[side.gridpoints[0]];
    return side.weights[0] * x[side.gridpoints[0]] + side.weights[1] * x[side.gridpoints[1]] +
           side.weights[2] * x[side.gridpoints[2]];
}

/// How far the sides of a sub-contact, which must be attached, are apart along the normal of its contact.
inline double gap_of_sides(const Model& model, Row sub_contact) {
    const auto& subs = model.sub_contacts;
    const Vec3 between =
        attached_position(model, subs.side2[sub_contact]) - attached_position(model, subs.side1[sub_contact]);
    return model.contacts.normal[subs.contact[sub_contact]].dot(between);
}

/// Whether a sub-contact has left the place on the faces that it had in a joint, which is open in part now; the place is known.
inline bool has_left_place(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    return follows_overlap(model, subs.contact[row]) && subs.side1[row].attached() && subs.side2[row].attached();
}

/// The place on the faces, midway between them.
Vec3 place_on_faces(const Model& model, Row row);
/// The opening there: the gap less the closure without force. Only where has_left_place.
double opening_on_faces(const Model& model, Row row);

/// The sub-contact that has the load at that place: where the joint is closed one that carries it, with the greatest pressure of the joint, else an unloaded one.
/// Only where has_left_place.
Row row_at_place(const Model& model, Row row);

/// Place and normal displacement of a sub-contact as users see them, opening positive. Carriers of an overlap lie where the force
/// acts; its unloaded rows stand for the places that the joint had, from the first on.
Vec3 shown_place(const Model& model, Row row);
double shown_opening(const Model& model, Row row);

} // namespace kaya
