// Quantities of sub-contacts. Normal force: compression positive; normal displacement: opening positive.
#include "model/fields/field_rows.hpp"
#include "model/measure/joint_opening.hpp"
#include "model/measure/overlap_rows.hpp"

#include <algorithm>

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::sub_contact;
constexpr auto rows_of = &Model::sub_contacts;

double shear_force_size(const Model& model, Row row) { return model.sub_contacts.shear_force[row].norm(); }
double shear_displacement_size(const Model& model, Row row) {
    return model.sub_contacts.shear_displacement[row].norm();
}

/// Over the area; a sub-contact without area carries no stress.
double stress(const Model& model, Row row, double force) {
    const double area = pressed_area(model, row);
    return area > 0 ? force / area : 0;
}
double normal_stress(const Model& model, Row row) { return stress(model, row, model.sub_contacts.normal_force[row]); }
double shear_stress(const Model& model, Row row) { return stress(model, row, shear_force_size(model, row)); }

/// The contact of a sub-contact.
Row contact_of(const Model& model, Row row) { return model.sub_contacts.contact[row]; }
template <auto column> FieldValue block(const Model& model, Row row) {
    return Link{ObjectKind::block, (model.contacts.*column)[contact_of(model, row)]};
}
template <auto column> FieldValue of_contact(const Model& model, Row row) {
    return value_of((model.contacts.*column)[contact_of(model, row)]);
}
template <auto column, int k> FieldValue of_contact(const Model& model, Row row) {
    return (model.contacts.*column)[contact_of(model, row)][k];
}
FieldValue constitutive(const Model& model, Row row) {
    return find_field(ObjectKind::contact, "constitutive")->get(model, contact_of(model, row));
}
double pressure_force(const Model& model, Row row) {
    return model.sub_contacts.pore_pressure[row] * wet_area(model, contact_of(model, row), row);
}

/// The vertex that meets a face, null where two edges meet.
FieldValue vertex(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    if (subs.type[row] >= SubContactType::edge_edge) return Link{ObjectKind::gridpoint, no_row};
    const Attachment& side = subs.type[row] == SubContactType::vertex_face ? subs.side1[row] : subs.side2[row];
    const auto heaviest = std::max_element(side.weights.begin(), side.weights.end()) - side.weights.begin();
    return Link{ObjectKind::gridpoint, side.gridpoints[static_cast<std::size_t>(heaviest)]};
}

/// The face opposite to the vertex; null for contacts without faces.
FieldValue face(const Model& model, Row row) {
    const auto& subs = model.sub_contacts;
    const Row contact = contact_of(model, row);
    if (subs.type[row] >= SubContactType::edge_edge) return Link{ObjectKind::face, no_row};
    return Link{ObjectKind::face, subs.type[row] == SubContactType::vertex_face ? model.contacts.face2[contact]
                                                                                : model.contacts.face1[contact]};
}

/// Records a force set from outside; the joint model must receive it.
void note_force(Model& model, Row row) {
    const SubContactId id = model.sub_contacts.id[row];
    if (model.forces_set.empty() || model.forces_set.back() != id) model.forces_set.push_back(id);
}
template <auto column> void write_force(Model& model, Row row, const FieldValue& value) {
    write<rows_of, column>(model, row, value);
    note_force(model, row);
}
template <auto column, int k> void write_force(Model& model, Row row, const FieldValue& value) {
    write<rows_of, column, k>(model, row, value);
    note_force(model, row);
}

FieldValue joint_model(const Model& model, Row row) {
    return find_field(ObjectKind::contact, "model")->get(model, contact_of(model, row));
}

} // namespace

const Fields& sub_contact_fields() {
    static const Fields rows{
        {table, "id", "cx_id", "block.subcontact.id", "-", "number, from 1", read<rows_of, &SubContacts::number>,
         nullptr},
        {table, "contact", "cx_contact", "block.subcontact.contact", "-", "contact that it belongs to",
         link<rows_of, &SubContacts::contact, ObjectKind::contact>, nullptr},
        {table, "block1", "", "block.subcontact.b1", "-", "block with the higher number", block<&Contacts::block1>,
         nullptr},
        {table, "block2", "", "block.subcontact.b2", "-", "block with the lower number", block<&Contacts::block2>,
         nullptr},
        {table, "type", "cx_type", "block.subcontact.type", "-", "1 vertex-face, 2 face-vertex, 3 edge-edge",
         read<rows_of, &SubContacts::type>, nullptr},
        {table, "position", "cx_pos", "block.subcontact.pos", "length", "where it is now", call<shown_place>, nullptr},
        {table, "x", "cx_x", "block.subcontact.pos.x", "length", "x", call<shown_place, 0>, nullptr},
        {table, "y", "cx_y", "block.subcontact.pos.y", "length", "y", call<shown_place, 1>, nullptr},
        {table, "z", "cx_z", "block.subcontact.pos.z", "length", "z", call<shown_place, 2>, nullptr},
        {table, "normal", "", "", "-", "unit normal of the contact, from block1 to block2",
         of_contact<&Contacts::normal>, nullptr},
        {table, "x_normal", "", "", "-", "x of the normal", of_contact<&Contacts::normal, 0>, nullptr},
        {table, "y_normal", "", "", "-", "y of the normal", of_contact<&Contacts::normal, 1>, nullptr},
        {table, "z_normal", "", "", "-", "z of the normal", of_contact<&Contacts::normal, 2>, nullptr},
        {table, "area", "cx_area", "block.subcontact.area", "area", "part of the contact's area", call<pressed_area>,
         nullptr},
        {table, "material", "cx_mat", "", "-", "number of its joint material", of_contact<&Contacts::material>,
         nullptr},
        {table, "constitutive", "cx_cons", "", "-", "number of its joint model, 0 when that has none", constitutive,
         nullptr},
        {table, "vertex", "cx_vertex", "block.subcontact.gp", "-", "vertex that meets a face, null between two edges",
         vertex, nullptr},
        {table, "face", "cx_face", "block.subcontact.face", "-", "face that a vertex meets, null when there is none",
         face, nullptr},
        {table, "pressure_force", "cx_ppforce", "block.subcontact.force.pp", "force", "pore pressure times area",
         call<pressure_force>, nullptr},
        {table, "group", "cx_group", "block.subcontact.group", "-",
         "group that it is in itself, else that of its contact; empty: none", read_group<ObjectKind::sub_contact>,
         write_group<ObjectKind::sub_contact>},
        {table, "model", "cx_model", "block.subcontact.model", "-", "name of its joint model, empty when it has none",
         joint_model, nullptr},
        {table, "normal_displacement", "cx_ndis", "block.subcontact.disp.norm", "length", "opening positive",
         call<shown_opening>, write<rows_of, &SubContacts::normal_displacement>},
        {table, "shear_displacement", "", "", "length", "length of the shear displacement vector",
         call<shear_displacement_size>, nullptr},
        {table, "shear_displacement_vector", "cx_sdis", "block.subcontact.disp.shear", "length", "in global axes",
         read<rows_of, &SubContacts::shear_displacement>, write<rows_of, &SubContacts::shear_displacement>},
        {table, "x_shear_displacement", "cx_xsdis", "block.subcontact.disp.shear.x", "length", "global x component",
         read<rows_of, &SubContacts::shear_displacement, 0>, write<rows_of, &SubContacts::shear_displacement, 0>},
        {table, "y_shear_displacement", "cx_ysdis", "block.subcontact.disp.shear.y", "length", "global y component",
         read<rows_of, &SubContacts::shear_displacement, 1>, write<rows_of, &SubContacts::shear_displacement, 1>},
        {table, "z_shear_displacement", "cx_zsdis", "block.subcontact.disp.shear.z", "length", "global z component",
         read<rows_of, &SubContacts::shear_displacement, 2>, write<rows_of, &SubContacts::shear_displacement, 2>},
        {table, "normal_force", "cx_nforce", "block.subcontact.force.norm", "force", "compression positive",
         read<rows_of, &SubContacts::normal_force>, write_force<&SubContacts::normal_force>},
        {table, "shear_force", "", "", "force", "length of the shear force vector", call<shear_force_size>, nullptr},
        {table, "shear_force_vector", "cx_sforce", "block.subcontact.force.shear", "force", "on block2, in global axes",
         read<rows_of, &SubContacts::shear_force>, write_force<&SubContacts::shear_force>},
        {table, "x_shear_force", "cx_xsforce", "block.subcontact.force.shear.x", "force", "global x component",
         read<rows_of, &SubContacts::shear_force, 0>, write_force<&SubContacts::shear_force, 0>},
        {table, "y_shear_force", "cx_ysforce", "block.subcontact.force.shear.y", "force", "global y component",
         read<rows_of, &SubContacts::shear_force, 1>, write_force<&SubContacts::shear_force, 1>},
        {table, "z_shear_force", "cx_zsforce", "block.subcontact.force.shear.z", "force", "global z component",
         read<rows_of, &SubContacts::shear_force, 2>, write_force<&SubContacts::shear_force, 2>},
        {table, "normal_stress", "", "block.subcontact.stress.norm", "stress",
         "normal force over area, compression positive", call<normal_stress>, nullptr},
        {table, "shear_stress", "", "block.subcontact.stress.shear", "stress", "length of the shear force over area",
         call<shear_stress>, nullptr},
        {table, "normal_stiffness", "", "", "stress/length", "tangent stiffness",
         read<rows_of, &SubContacts::normal_stiffness>, nullptr},
        {table, "shear_stiffness", "", "", "stress/length", "tangent stiffness",
         read<rows_of, &SubContacts::shear_stiffness>, nullptr},
        {table, "pore_pressure", "cx_pp", "block.subcontact.pp", "stress", "in the joint, compression positive",
         read<rows_of, &SubContacts::pore_pressure>, write<rows_of, &SubContacts::pore_pressure>},
        {table, "frictional_work", "", "", "energy", "done by slip", read<rows_of, &SubContacts::frictional_work>,
         nullptr},
        {table, "state", "cx_state", "block.subcontact.state", "-", "sum of 1, 2, 4, ... for the model's state names",
         read<rows_of, &SubContacts::state>, write<rows_of, &SubContacts::state>},
    };
    return rows;
}

} // namespace kaya::field_rows
