// The sub-contacts of an overlap of two rigid blocks: docs/theory/contacts.md.
#pragma once

#include "model/tables/model.hpp"

#include <algorithm>

namespace kaya {

/// Sub-contacts that carry the force of an overlap; the others are unloaded.
constexpr Row carriers = 4;

/// Both blocks are rigid.
inline bool between_rigid(const Model& model, Row contact) {
    const auto& deformable = model.blocks.deformable;
    return !deformable[model.contacts.block1[contact]] && !deformable[model.contacts.block2[contact]];
}

/// Whether the contact's force follows from the overlap; never in small strain, where places are fixed.
inline bool follows_overlap(const Model& model, Row contact) {
    return model.contacts.kind[contact] == ContactKind::overlap && model.settings.large_strain;
}

/// Whether a sub-contact of an overlap carries none of its force.
inline bool is_unloaded(const Model& model, Row contact, Row row) {
    return follows_overlap(model, contact) && row >= model.contacts.sub_contacts[contact].first + carriers;
}

/// Whether water acts on the whole common area of the faces of an overlap, at the unloaded rows.
inline bool is_wet_beyond(const Contacts& contacts, Row contact) {
    return contacts.whole_area[contact] > 0 && contacts.sub_contacts[contact].count > carriers;
}

/// The unloaded rows that stand for the common area of the faces, and the area of each.
struct WetRows {
    Row first, count;
    double area;

    WetRows(const Contacts& contacts, Row contact)
        : first(contacts.sub_contacts[contact].first + carriers),
          count(std::min(contacts.sub_contacts[contact].count - carriers, carriers)),
          area(contacts.whole_area[contact] / static_cast<double>(count)) {}
    double of(Row row) const { return row >= first && row < first + count ? area : 0; }
};

/// Gives the unloaded rows what is left of the common area of the faces, so that listed areas have its sum.
inline void put_open_area(Model& model, Row contact) {
    if (!is_wet_beyond(model.contacts, contact)) return;
    const Span span = model.contacts.sub_contacts[contact];
    const double open = std::max(0.0, model.contacts.whole_area[contact] - model.contacts.area[contact]);
    for (Row s = span.first + carriers; s < span.end(); ++s)
        if (model.sub_contacts.area[s] > 0)
            model.sub_contacts.area[s] = open / static_cast<double>(span.count - carriers);
}

/// The common area of the faces of a joint; of edges and corners the area of their contact.
inline double common_area(const Model& model, Row contact) {
    const Contacts& contacts = model.contacts;
    return follows_overlap(model, contact) ? std::max(contacts.whole_area[contact], contacts.area[contact])
                                           : contacts.area[contact];
}

/// The part of it that carries nothing.
inline double idle_area(const Model& model, Row contact) {
    const Contacts& contacts = model.contacts;
    if (follows_overlap(model, contact))
        return contacts.depth[contact] > 0 ? std::max(0.0, common_area(model, contact) - contacts.shear_area[contact])
                                           : common_area(model, contact);
    double area = 0;
    const Span span = contacts.sub_contacts[contact];
    for (Row s = span.first; s < span.end(); ++s)
        if (model.sub_contacts.normal_force[s] <= 0) area += model.sub_contacts.area[s];
    return area;
}

/// The area on which the normal force of a sub-contact acts with the greatest pressure of its contact: less than the closed area, which joint
/// models see, where a joint of rigid blocks is open in part.
inline double pressed_area(const Model& model, Row row) {
    const Row contact = model.sub_contacts.contact[row];
    const Contacts& contacts = model.contacts;
    return follows_overlap(model, contact) && !is_unloaded(model, contact, row) && contacts.depth[contact] > 0
               ? contacts.area[contact] / static_cast<double>(carriers)
               : model.sub_contacts.area[row];
}

/// The area of a sub-contact on which water in the joint acts.
inline double wet_area(const Model& model, Row contact, Row row) {
    if (!follows_overlap(model, contact) || !is_wet_beyond(model.contacts, contact))
        return model.sub_contacts.area[row];
    return WetRows(model.contacts, contact).of(row);
}

} // namespace kaya
