// Contacts between two blocks and the sub-contacts that carry their forces.
#pragma once

#include "base/id.hpp"
#include "model/tables/blocks.hpp"
#include "model/tables/column.hpp"

#include "laws/joint_object.hpp"

#include <array>
#include <cstdint>

namespace kaya {

struct ContactTag {};
using ContactId = Id<ContactTag>;
struct SubContactTag {};
using SubContactId = Id<SubContactTag>;

/// Type of contact of two blocks.
enum class ContactType : std::int32_t { face_face = 1, face_edge, face_vertex, edge_edge, edge_vertex, vertex_vertex };

/// Features in contact at a sub-contact.
enum class SubContactType : std::int32_t { vertex_face = 1, face_vertex, edge_edge, face_face };

/// How the normal force of a contact is defined.
enum class ContactKind : std::int32_t {
    joint,  ///< the closure of fixed places of the joint
    overlap ///< the volume that two rigid blocks have in common
};

class SubContacts;

class Contacts : public Table<Contacts> {
public:
    IdMap<ContactTag> ids;

    Column<ContactId> id;
    Column<std::int32_t> number; ///< counts from 1; what users see
    Column<Row> block1;          ///< the block with the higher number
    Column<Row> block2;
    Column<Row> face1; ///< parallel faces, no_row unless the contact is face-face
    Column<Row> face2;
    Column<ContactType> type;
    Column<std::int32_t> reference; ///< whose face gives the normal: 1, 2, or 0 for two edges
    Column<Vec3> normal;            ///< of the common plane, unit, from block1 to block2
    Column<Vec3> position;          ///< a point of the common plane
    Column<double> area;            ///< of the overlap
    Column<std::int32_t> material;  ///< number of `prop jmat`
    Column<Row> properties;         ///< row of Model::joint_properties: model and values
    Column<std::int32_t> joint_set;
    Column<std::int32_t> group; ///< index into Model::group_names, 0 is none
    Column<Span> sub_contacts;  ///< a contact's rows are contiguous
    Column<ContactKind> kind;
    Column<double> least_area; ///< a loaded contact is at least as stiff as a joint of this area
    Column<double>
        stiffness_area; ///< normal tangent stiffness of the contact over that of its joint model; 0: that of the sub-contacts
    // Of overlap contacts only.
    Column<double>
        shear_area;       ///< largest area on which it has touched since it last carried nothing: of its shear springs
    Column<double> grip;  ///< shear over normal force where its joint model has limited it last; 0: not known
    Column<double> depth; ///< closure of a joint of its area with the force of the overlap; 0 when the blocks are apart
    Column<double> twist; ///< moment of the overlap about the normal over its normal force: length
    Column<double> offset;        ///< closure in addition to that of the positions of the blocks
    Column<Vec3> offset_tilt;     ///< its slope in space, about the centroid of block1
    Column<Vec3> offset_normal;   ///< unit; its direction, which turns with the blocks and not with the normal
    Column<Vec3> axis;            ///< a direction in the plane that turns with the contact
    Column<double> energy_length; ///< energy of the overlap over its normal force
    Column<double> energy_taken;  ///< energy taken and not yet returned
    Column<double> withheld;      ///< part of its force that does not act, so that it returns no more than that
    Column<double> whole_area;    ///< common area of the faces of an overlap; 0 when it is not known
    // Of joints within which the water ends: mechanics/supports/water.hpp.
    Column<double> water_pressure; ///< continued to the centroid of block1, beside zones to the first sub-contact
    Column<Vec3>
        water_slope; ///< of the pressure, in the plane; both are 0 where water covers all of the joint or nothing
    Column<std::uint32_t> torn; ///< bit k: place k of the joint has been open; mechanics/contact/torn_bonds.hpp
    // Of overlap contacts with a curved joint model: mechanics/contact/closed_halves.hpp.
    Column<std::int32_t> curved;                ///< 1: it has two halves
    Column<double> energy_deep, energy_shallow; ///< of the normal spring of each half, over its area
    // Of joints only.
    Column<double> slip_since_update; ///< relative tangential motion since the last geometry update
    Column<double> unforced_overlap;  ///< overlap beyond the one that its force explains
    Column<double> withdrawn_energy;  ///< energy taken by geometry updates, less what was returned

    template <class Visit> void columns(Visit&& visit) {
        visit("id", id, Role::identity);
        visit("number", number, Role::identity);
        visit("block1", block1, link<Blocks>());
        visit("block2", block2, link<Blocks>());
        visit("face1", face1, link_or_none<Faces>());
        visit("face2", face2, link_or_none<Faces>());
        visit("touch", type, Role::geometry);
        visit("reference", reference, Role::geometry);
        visit("normal", normal, Role::geometry);
        visit("position", position, Role::geometry);
        visit("area", area, Role::geometry);
        visit("material", material, Role::setting);
        visit("properties", properties, ColumnRole<JointProperties>{Role::setting, true});
        visit("joint_set", joint_set, Role::setting);
        visit("group", group, setting<Group>());
        visit("sub_contacts", sub_contacts, link<SubContacts>());
        visit("kind", kind, Role::geometry);
        visit("least_area", least_area, Role::geometry);
        visit("stiffness_area", stiffness_area, Role::geometry);
        visit("shear_area", shear_area, Role::geometry);
        visit("grip", grip, Role::state);
        visit("depth", depth, Role::state);
        visit("twist", twist, Role::state);
        visit("offset", offset, Role::geometry);
        visit("offset_tilt", offset_tilt, Role::geometry);
        visit("offset_normal", offset_normal, Role::geometry);
        visit("axis", axis, Role::geometry);
        visit("energy_length", energy_length, Role::state);
        visit("energy_taken", energy_taken, Role::state);
        visit("curved", curved, Role::state);
        visit("whole_area", whole_area, Role::geometry);
        visit("torn", torn, Role::state);
        visit("water_pressure", water_pressure, Role::condition);
        visit("water_slope", water_slope, Role::condition);
        visit("energy_deep", energy_deep, Role::state);
        visit("energy_shallow", energy_shallow, Role::state);
        visit("withheld", withheld, Role::state);
        visit("slid", slip_since_update, Role::state);
        visit("given_up", withdrawn_energy, Role::state);
        visit("sunk", unforced_overlap, Role::state);
    }
};

/// One side of a sub-contact: up to three gridpoints and their weights (which sum to 1).
struct Attachment {
    std::array<Row, 3> gridpoints{no_row, no_row, no_row};
    std::array<double, 3> weights{0, 0, 0};

    /// False when the shape of its block has changed and the contact has not been checked since.
    bool attached() const { return gridpoints[0] != no_row; }
    bool operator==(const Attachment&) const = default;
};

class SubContacts : public Table<SubContacts> {
public:
    IdMap<SubContactTag> ids;

    Column<SubContactId> id;
    Column<std::int32_t> number;
    Column<Row> contact;
    Column<SubContactType> type;
    Column<std::int32_t> group; ///< of the sub-contact itself: index into Model::group_names, 0 is none
    Column<Attachment> side1;
    Column<Attachment> side2;
    VectorColumn position;

    // Columns that joint models see (defined in include/kaya/jmodel.h).
    Column<double> area;
    Column<double> normal_displacement;
    Column<double> normal_displacement_increment;
    VectorColumn shear_displacement;
    VectorColumn shear_displacement_increment;
    Column<double> pore_pressure;
    Column<double> normal_force;
    VectorColumn shear_force;      ///< on block2 is plus this, on block1 minus: see method
    VectorColumn shear_arm;        ///< of overlap contacts: the place of the shear force, relative to `position`
    Column<double> dashpot_normal; ///< viscous force in addition to the law's, with damping
    VectorColumn dashpot_shear;
    Column<double> normal_stiffness;
    Column<double> shear_stiffness;
    Column<double> frictional_work;
    Column<std::uint32_t> state;
    std::array<Column<double>, KAYA_JMODEL_MAX_HISTORY> history; ///< those after `history_columns` are empty
    std::int32_t history_columns = 0;                            ///< the largest number that a joint model needs

    // Fields that joint models only read; a row whose bit is not set has the property, or the initial value.
    std::array<Column<double>, KAYA_JMODEL_MAX_FIELDS> field; ///< those after `field_columns` are empty
    Column<std::uint32_t> field_set;                          ///< bit k: field k was set
    std::int32_t field_columns = 0;                           ///< as many as the joint model has, if one was set

    /// Beside zones: where a pressure that is linear has its mean over the part of the joint that the sub-contact stands for, relative to `position`.
    VectorColumn load_arm;
    bool keeps_load_arms = false; ///< whether any block has zones; otherwise the column is empty

    Column<JointObject> object; ///< history of a joint model that plain numbers cannot hold
    bool keeps_objects = false; ///< whether a joint model does; otherwise the column is empty

    /// Where the shear force acts.
    Vec3 shear_place(Row row) const { return Vec3(position[row]) + Vec3(shear_arm[row]); }

    /// Where a traction on the part of the joint that it stands for has its mean.
    Vec3 load_place(Row row) const {
        return keeps_load_arms ? Vec3(position[row]) + Vec3(load_arm[row]) : Vec3(position[row]);
    }

    /// Allocates the places of loads; they are never released.
    void keep_load_arms() {
        keeps_load_arms = true;
        for (auto& column : load_arm.component) column.assign(size(), 0.0);
    }

    /// Allocates objects for a joint model; they are never released.
    void keep_objects() {
        keeps_objects = true;
        object.resize(size());
    }

    /// Allocates history columns for a joint model; they are never released.
    void keep_history(std::size_t columns) {
        while (static_cast<std::size_t>(history_columns) < columns) history[history_columns++].assign(size(), 0.0);
    }

    /// Allocates fields; they are never released.
    void keep_fields(std::size_t columns) {
        if (field_columns == 0 && columns > 0) field_set.assign(size(), 0);
        while (static_cast<std::size_t>(field_columns) < columns) field[field_columns++].assign(size(), 0.0);
    }
    void set_field(std::size_t k, Row row, double value) {
        field[k][row] = value;
        field_set[row] |= 1u << k;
    }

    /// Clears the history of another joint model, and the values that the user has set for it.
    void forget(Row row) {
        for (std::int32_t k = 0; k < history_columns; ++k) history[k][row] = 0;
        for (std::int32_t k = 0; k < field_columns; ++k) field[k][row] = 0;
        if (field_columns > 0) field_set[row] = 0;
        if (keeps_objects) object[row].reset();
    }

    template <class Visit> void columns(Visit&& visit) {
        visit("id", id, Role::identity);
        visit("number", number, Role::identity);
        visit("contact", contact, link<Contacts>());
        visit("meeting", type, Role::geometry);
        visit("group", group, setting<Group>());
        visit("side1", side1, link_or_none<Gridpoints>());
        visit("side2", side2, link_or_none<Gridpoints>());
        visit_vector(visit, "position", position, Role::geometry);
        visit("area", area, Role::geometry);
        visit("normal_displacement", normal_displacement, Role::displacement);
        visit("normal_displacement_increment", normal_displacement_increment, Role::state);
        visit_vector(visit, "shear_displacement", shear_displacement, Role::displacement);
        visit_vector(visit, "shear_displacement_increment", shear_displacement_increment, Role::state);
        visit("pore_pressure", pore_pressure, Role::condition);
        visit("normal_force", normal_force, Role::state);
        visit_vector(visit, "shear_force", shear_force, Role::state);
        visit_vector(visit, "shear_arm", shear_arm, Role::state);
        visit("dashpot_normal", dashpot_normal, Role::state);
        visit_vector(visit, "dashpot_shear", dashpot_shear, Role::state);
        visit("normal_stiffness", normal_stiffness, Role::state);
        visit("shear_stiffness", shear_stiffness, Role::state);
        visit("frictional_work", frictional_work, Role::state);
        visit("state", state, Role::state);
        for (std::size_t k = 0; k < history.size() && static_cast<std::int32_t>(k) < history_columns; ++k)
            visit("history_" + std::to_string(k), history[k], Role::state);
        for (std::size_t k = 0; k < field.size() && static_cast<std::int32_t>(k) < field_columns; ++k)
            visit("field_" + std::to_string(k), field[k], Role::setting);
        if (field_columns > 0) visit("field_set", field_set, Role::setting);
        if (keeps_load_arms) visit_vector(visit, "load_arm", load_arm, Role::geometry);
        if (keeps_objects) visit("object", object, Role::state);
    }
};

} // namespace kaya
