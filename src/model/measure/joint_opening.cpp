#include "model/measure/joint_opening.hpp"

namespace kaya {

namespace {

/// The row whose place an unloaded one stands for.
Row stands_for(const Model& model, Row row) {
    const Row contact = model.sub_contacts.contact[row];
    return is_unloaded(model, contact, row) && has_left_place(model, row - carriers) ? row - carriers : no_row;
}

} // namespace

Vec3 place_on_faces(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    return 0.5 * (attached_position(model, subs.side1[row]) + attached_position(model, subs.side2[row]));
}

double opening_on_faces(const Model& model, Row row) {
    const auto& contacts = model.contacts;
    const Row contact = model.sub_contacts.contact[row];
    const Vec3 arm = place_on_faces(model, row) - model.blocks.centroid[contacts.block1[contact]];
    return gap_of_sides(model, row) - contacts.offset[contact] - contacts.offset_tilt[contact].dot(arm);
}

Row row_at_place(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[subs.contact[row]];
    if (opening_on_faces(model, row) < 0) {
        const Vec3 place = place_on_faces(model, row);
        Row nearest = span.first;
        for (Row s = span.first + 1; s < span.first + carriers; ++s)
            if ((subs.position[s] - place).squaredNorm() < (subs.position[nearest] - place).squaredNorm()) nearest = s;
        return nearest;
    }
    return row < span.first + carriers && row + carriers < span.end() ? row + carriers : row;
}

Vec3 shown_place(const Model& model, Row row) {
    const Row place = stands_for(model, row);
    return place == no_row ? Vec3(model.sub_contacts.position[row]) : place_on_faces(model, place);
}

double shown_opening(const Model& model, Row row) {
    const Row place = stands_for(model, row);
    return place == no_row ? model.sub_contacts.normal_displacement[row] : opening_on_faces(model, place);
}

} // namespace kaya
