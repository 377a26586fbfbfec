// Quantities of contacts; forces are sums, displacements are means over the sub-contacts.
#include "model/fields/field_rows.hpp"
#include "model/measure/joint_opening.hpp"

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::contact;
constexpr auto rows_of = &Model::contacts;

double normal_force(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    double sum = 0;
    for (Row i = span.first; i < span.end(); ++i) sum += model.sub_contacts.normal_force[i];
    return sum;
}

Vec3 shear_force(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    Vec3 sum = Vec3::Zero();
    for (Row i = span.first; i < span.end(); ++i) sum += model.sub_contacts.shear_force[i];
    return sum;
}

/// Mean weighted with area; equally where no sub-contact has an area.
double normal_displacement(const Model& model, Row contact) {
    const Span span = model.contacts.sub_contacts[contact];
    const auto& sub_contacts = model.sub_contacts;
    double weighted = 0, plain = 0, area = 0;
    for (Row i = span.first; i < span.end(); ++i) {
        const double opening = shown_opening(model, i);
        weighted += sub_contacts.area[i] * opening;
        plain += opening;
        area += sub_contacts.area[i];
    }
    if (area > 0) return weighted / area;
    return span.count > 0 ? plain / span.count : 0;
}

FieldValue joint_model(const Model& model, Row contact) {
    const Row properties = model.contacts.properties[contact];
    if (properties == no_row) return std::string();
    return model.joint_properties[static_cast<std::size_t>(properties)].model;
}

/// Number that `change jcons` would give it; 0 when its model has none.
std::int64_t constitutive(const Model& model, Row contact) {
    const Row properties = model.contacts.properties[contact];
    if (properties == no_row) return 0;
    const std::string& name = model.joint_properties[static_cast<std::size_t>(properties)].model;
    for (const auto& [number, joint_model] : model.joint_constitutive)
        if (joint_model == name) return number;
    return 0;
}

} // namespace

const Fields& contact_fields() {
    static const Fields rows{
        {table, "id", "c_id", "block.contact.id", "-", "number, from 1", read<rows_of, &Contacts::number>, nullptr},
        {table, "type", "c_type", "block.contact.type", "-",
         "1 face-face, 2 face-edge, 3 face-vertex, 4 edge-edge, 5 edge-vertex, 6 vertex-vertex",
         read<rows_of, &Contacts::type>, nullptr},
        {table, "block1", "c_b1", "block.contact.b1", "-", "block with the higher number",
         link<rows_of, &Contacts::block1, ObjectKind::block>, nullptr},
        {table, "block2", "c_b2", "block.contact.b2", "-", "block with the lower number",
         link<rows_of, &Contacts::block2, ObjectKind::block>, nullptr},
        {table, "first_sub_contact", "c_cx", "", "-", "first of its sub-contacts",
         first<rows_of, &Contacts::sub_contacts, ObjectKind::sub_contact>, nullptr},
        {table, "position", "c_pos", "block.contact.pos", "length", "a point of the common plane",
         read<rows_of, &Contacts::position>, nullptr},
        {table, "x", "c_x", "block.contact.pos.x", "length", "x", read<rows_of, &Contacts::position, 0>, nullptr},
        {table, "y", "c_y", "block.contact.pos.y", "length", "y", read<rows_of, &Contacts::position, 1>, nullptr},
        {table, "z", "c_z", "block.contact.pos.z", "length", "z", read<rows_of, &Contacts::position, 2>, nullptr},
        {table, "normal", "c_n", "block.contact.normal", "-", "unit normal from block1 to block2",
         read<rows_of, &Contacts::normal>, nullptr},
        {table, "x_normal", "c_nx", "block.contact.normal.x", "-", "x of the normal",
         read<rows_of, &Contacts::normal, 0>, nullptr},
        {table, "y_normal", "c_ny", "block.contact.normal.y", "-", "y of the normal",
         read<rows_of, &Contacts::normal, 1>, nullptr},
        {table, "z_normal", "c_nz", "block.contact.normal.z", "-", "z of the normal",
         read<rows_of, &Contacts::normal, 2>, nullptr},
        {table, "area", "c_area", "block.contact.area", "area", "area of the overlap", read<rows_of, &Contacts::area>,
         nullptr},
        {table, "material", "c_mat", "", "-", "number of its joint material", read<rows_of, &Contacts::material>,
         nullptr},
        {table, "constitutive", "c_cons", "", "-", "number of its joint model, 0 when that has none",
         call<constitutive>, nullptr},
        {table, "joint_set", "c_jset", "block.contact.jset", "-", "joint set that made it, 0 for none",
         read<rows_of, &Contacts::joint_set>, nullptr},
        {table, "group", "c_group", "block.contact.group", "-", "group of the contact, empty when it has none",
         read_group<ObjectKind::contact>, write_group<ObjectKind::contact>},
        {table, "model", "c_model", "block.contact.model", "-", "name of its joint model, empty when it has none",
         joint_model, nullptr},
        {table, "normal_displacement", "c_ndis", "", "length", "mean, opening positive", call<normal_displacement>,
         nullptr},
        {table, "normal_force", "c_nforce", "", "force", "sum, compression positive", call<normal_force>, nullptr},
        {table, "shear_force", "", "", "force", "sum of the shear force vectors", call<shear_force>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
