// A small model with rows in every table: a deformable tetrahedron (block 1) on a rigid one (block 2), with one contact of two sub-contacts
// between them. Shared by the tests of model and io.
#pragma once

#include "model/tables/model.hpp"

namespace kaya::test {

/// Adds a tetrahedron with its four faces of one triangle each. The corners must have positive volume.
inline Row add_tetrahedron(Model& model, const std::array<Vec3, 4>& corners, bool deformable) {
    const auto block = static_cast<Row>(model.blocks.size());
    const auto first_gridpoint = static_cast<Row>(model.gridpoints.size());
    const auto first_face = static_cast<Row>(model.faces.size());
    const auto first_zone = static_cast<Row>(model.zones.size());

    auto& blocks = model.blocks;
    blocks.resize(blocks.size() + 1);
    blocks.id[block] = blocks.ids.create(block);
    blocks.number[block] = model.next_block_number++;
    blocks.shape[block] = model.next_shape_number++;
    blocks.material[block] = 1;
    blocks.constitutive[block] = 1;
    blocks.deformable[block] = deformable;
    blocks.gridpoints[block] = {first_gridpoint, 4};
    blocks.faces[block] = {first_face, 4};
    blocks.triangles[block] = {first_face, 4};
    blocks.zones[block] = {first_zone, deformable ? 1 : 0};
    blocks.centroid[block] = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    blocks.volume[block] = 1.0 / 6.0;
    blocks.inertia[block] = Mat3::Identity();
    blocks.orientation[block] = Quaternion(1, 0, 0, 0);

    model.gridpoints.resize(model.gridpoints.size() + 4);
    for (Row k = 0; k < 4; ++k) {
        model.gridpoints.block[first_gridpoint + k] = block;
        model.gridpoints.position[first_gridpoint + k] = corners[k];
        model.gridpoints.reference[first_gridpoint + k] = corners[k];
    }

    constexpr std::array<std::array<Row, 3>, 4> sides{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    model.faces.resize(model.faces.size() + 4);
    model.triangles.resize(model.triangles.size() + 4);
    for (Row k = 0; k < 4; ++k) {
        model.faces.block[first_face + k] = block;
        model.faces.triangles[first_face + k] = {first_face + k, 1};
        model.triangles.face[first_face + k] = first_face + k;
        for (std::size_t j = 0; j < 3; ++j)
            model.triangles.gridpoints[first_face + k][j] = first_gridpoint + sides[static_cast<std::size_t>(k)][j];
        model.faces.normal[first_face + k] = Vec3(0, 0, -1);
    }

    if (deformable) {
        model.zones.resize(model.zones.size() + 1);
        model.zones.block[first_zone] = block;
        model.zones.gridpoints[first_zone] = {first_gridpoint, first_gridpoint + 1, first_gridpoint + 2,
                                              first_gridpoint + 3};
        model.zones.volume[first_zone] = 1.0 / 6.0;
    }
    return block;
}

/// One contact from block row 1 to block row 0 with two sub-contacts at the given x.
inline void add_contact(Model& model, double x1, double x2) {
    auto& contacts = model.contacts;
    contacts.resize(1);
    contacts.id[0] = contacts.ids.create(0);
    contacts.number[0] = model.next_contact_number++;
    contacts.block1[0] = 1;
    contacts.block2[0] = 0;
    contacts.face1[0] = 4;
    contacts.face2[0] = 0;
    contacts.type[0] = ContactType::face_face;
    contacts.normal[0] = Vec3(0, 0, 1);
    contacts.position[0] = Vec3(0.5 * (x1 + x2), 0.25, 0);
    contacts.area[0] = 0.5;
    contacts.material[0] = 3;
    contacts.properties[0] = 0;
    contacts.joint_set[0] = 2;
    contacts.sub_contacts[0] = {0, 2};

    auto& sub = model.sub_contacts;
    sub.resize(2);
    sub.keep_history(16);
    for (Row i = 0; i < 2; ++i) {
        sub.id[i] = sub.ids.create(i);
        sub.number[i] = model.next_sub_contact_number++;
        sub.contact[i] = 0;
        sub.type[i] = SubContactType::vertex_face;
        sub.side1[i] = {{4, 5, 6}, {0.25, 0.25, 0.5}};
        sub.side2[i] = {{i, no_row, no_row}, {1, 0, 0}};
        sub.position.set(i, Vec3(i == 0 ? x1 : x2, 0.25, 0));
        sub.area[i] = 0.25;
        sub.normal_displacement[i] = -0.001 * (i + 1);
        sub.shear_displacement.set(i, Vec3(3e-3, 4e-3, 0));
        sub.normal_force[i] = 10.0 * (i + 1);
        sub.shear_force.set(i, Vec3(-3, -4, 0));
        sub.normal_stiffness[i] = 1e4;
        sub.shear_stiffness[i] = 5e3;
        sub.state[i] = 1u + static_cast<unsigned>(i);
        sub.history[0][i] = 0.125 * (i + 1);
        sub.history[15][i] = -7.5;
    }
}

inline Model hand_made_model() {
    Model model;
    add_tetrahedron(model, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, true);
    add_tetrahedron(model, {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)}, false);
    model.zones.stress[0] << -1, -2, -3, 0.1, 0.2, 0.3;
    for (Row i = 0; i < 4; ++i) {
        model.gridpoints.velocity[i] = Vec3(0.5 * i, 0, 0);
        model.gridpoints.displacement[i] = Vec3(0, 0.01 * i, 0);
        model.gridpoints.force[i] = Vec3(0, 0, i);
        model.gridpoints.mass[i] = 1 + i;
    }
    model.blocks.velocity[1] = Vec3(1, 2, 3);
    model.blocks.force[1] = Vec3(4, 5, 6);
    model.blocks.region[1] = 7;
    model.group_names.push_back("base");
    model.blocks.group[1] = 1;
    model.materials[1].density = 2000;
    model.materials[1].bulk = 1e9;
    model.materials[1].shear = 5e8;
    model.materials[3].joint = {{"jkn", 1e4}, {"jfric", 30}};
    model.joint_properties.push_back({"mohr", 3, {1e4, 5e3, 30}, "deck.3dd:23"});
    model.joint_constitutive[1] = "mohr";
    model.settings.gravity = Vec3(0, 0, -9.81);
    model.settings.damping = Damping::global;
    model.clock.time = 0.1;
    model.clock.cycle = 42;
    model.clock.unbalanced_force = 12.5;
    model.histories.interval = 1;
    model.stale.contacts_found();
    add_contact(model, 0.25, 0.5);
    return model;
}

} // namespace kaya::test
