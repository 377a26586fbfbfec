// Quantities of beams and liners: of their nodes and of their elements.
#include "model/fields/field_rows.hpp"
#include "model/structures/members.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace kaya::field_rows {

namespace {

const MemberNodes& nodes_of(const Model& model) { return model.structures.member_nodes; }
const BeamElements& beams_of(const Model& model) { return model.structures.beams; }
const LinerElements& liners_of(const Model& model) { return model.structures.liners; }

std::int64_t number_of(const Model& model, Row member) { return model.structures.members.number[member]; }
std::int64_t property_of(const Model& model, Row member) { return model.structures.members.property[member]; }
const StructureProperties& properties_of(const Model& model, Row member) {
    static const StructureProperties none;
    const auto found = model.structures.properties.find(model.structures.members.property[member]);
    return found == model.structures.properties.end() ? none : found->second;
}

// --- nodes ------------------------------------------------------------------------------------------------------

std::int64_t node_number(const Model& m, Row node) { return number_of(m, nodes_of(m).member[node]); }
std::int64_t node_property(const Model& m, Row node) { return property_of(m, nodes_of(m).member[node]); }
FieldValue node_block(const Model& m, Row node) { return Link{ObjectKind::block, rock_block(m, nodes_of(m), node)}; }
template <auto column> Vec3 of_node(const Model& m, Row node) { return (nodes_of(m).*column)[node]; }
template <auto column> void set_of_node(Model& m, Row node, const FieldValue& value) {
    (m.structures.member_nodes.*column)[node] = vector(value);
}
Vec3 rotation(const Model& m, Row node) {
    const Eigen::AngleAxisd turn(quaternion(nodes_of(m).rotation[node]));
    return turn.angle() * turn.axis();
}
std::int64_t hold(const Model& m, Row node) { return static_cast<std::int64_t>(hold_of(m, node)); }
std::int64_t link_state(const Model& m, Row node) { return nodes_of(m).link_state[node]; }
double mass(const Model& m, Row node) { return nodes_of(m).mass[node]; }
double inertial_mass(const Model& m, Row node) { return nodes_of(m).inertial_mass[node]; }

// --- beam elements ----------------------------------------------------------------------------------------------

std::int64_t beam_number(const Model& m, Row row) { return number_of(m, beams_of(m).member[row]); }
std::int64_t beam_property(const Model& m, Row row) { return property_of(m, beams_of(m).member[row]); }
Vec3 beam_place(const Model& m, Row row) {
    const auto& [a, b] = beams_of(m).nodes[row];
    return 0.5 * (nodes_of(m).position[a] + nodes_of(m).position[b]);
}
double beam_length(const Model& m, Row row) {
    const auto& [a, b] = beams_of(m).nodes[row];
    return (nodes_of(m).position[b] - nodes_of(m).position[a]).norm();
}
double axial(const Model& m, Row row) { return beams_of(m).axial[row]; }
double torsion(const Model& m, Row row) { return beams_of(m).torsion[row]; }
template <int k> double shear(const Model& m, Row row) { return beams_of(m).shear[row][k]; }
template <int k> double moment(const Model& m, Row row) { return beams_of(m).moments[row][k]; }
double largest_moment(const Model& m, Row row) {
    const auto& all = beams_of(m).moments[row];
    return std::max(std::hypot(all[0], all[2]), std::hypot(all[1], all[3]));
}
double beam_plastic_strain(const Model& m, Row row) {
    const auto& [a, b] = beams_of(m).nodes[row];
    return beams_of(m).extension_lost[row] / (nodes_of(m).reference[b] - nodes_of(m).reference[a]).norm();
}
double hinge(const Model& m, Row row) {
    double most = 0;
    for (const double turn : beams_of(m).hinges[row]) most = std::max(most, std::abs(turn));
    return most;
}
std::int64_t beam_state(const Model& m, Row row) { return beams_of(m).state[row]; }

// --- liner elements ---------------------------------------------------------------------------------------------

std::int64_t liner_number(const Model& m, Row row) { return number_of(m, liners_of(m).member[row]); }
std::int64_t liner_property(const Model& m, Row row) { return property_of(m, liners_of(m).member[row]); }
Vec3 corner(const Model& m, Row row, std::size_t k) { return nodes_of(m).position[liners_of(m).nodes[row][k]]; }
Vec3 liner_place(const Model& m, Row row) { return (corner(m, row, 0) + corner(m, row, 1) + corner(m, row, 2)) / 3; }
double liner_area(const Model& m, Row row) {
    return 0.5 * (corner(m, row, 1) - corner(m, row, 0)).cross(corner(m, row, 2) - corner(m, row, 0)).norm();
}
Vec3 axis(const Model& m, Row row) { return liners_of(m).axis[row]; }
Vec3 normal(const Model& m, Row row) { return liners_of(m).normal[row]; }
template <int k> double membrane(const Model& m, Row row) { return liners_of(m).membrane[row][k]; }
template <int k> double plate_moment(const Model& m, Row row) { return liners_of(m).moment[row][k]; }

/// The greater and the smaller principal value of xx, yy, xy.
std::array<double, 2> principal(const Vec3& value) {
    const double mean = 0.5 * (value[0] + value[1]), radius = std::hypot(0.5 * (value[0] - value[1]), value[2]);
    return {mean + radius, mean - radius};
}
template <int k> double principal_membrane(const Model& m, Row row) { return principal(liners_of(m).membrane[row])[k]; }
template <int k> double principal_moment(const Model& m, Row row) { return principal(liners_of(m).moment[row])[k]; }
/// The greatest (0) or least (1) principal stress at the two surfaces.
template <int k> double extreme_stress(const Model& m, Row row) {
    const double t = properties_of(m, liners_of(m).member[row]).thickness;
    if (!(t > 0)) return 0;
    const Vec3 middle = liners_of(m).membrane[row] / t, bending = 6 / (t * t) * liners_of(m).moment[row];
    const double out = principal(middle + bending)[k], in = principal(middle - bending)[k];
    return k == 0 ? std::max(out, in) : std::min(out, in);
}

} // namespace

const Fields& member_fields() {
    constexpr auto node = ObjectKind::structure_node, beam = ObjectKind::beam_element,
                   liner = ObjectKind::liner_element;
    constexpr auto at = &MemberNodes::position;
    constexpr auto shift = &MemberNodes::displacement;
    constexpr auto on_rock = &MemberNodes::rock_force;
    // clang-format off
    static const Fields rows{
        {node, "id", "", "", "-", "number, from 1; changes when beams or liners are deleted", call<count_from_one>, nullptr},
        {node, "structure", "", "", "-", "number of its beam or liner", call<node_number>, nullptr},
        {node, "property", "", "", "-", "number of its properties", call<node_property>, nullptr},
        {node, "block", "", "", "-", "block that it lies on", node_block, nullptr},
        {node, "position", "", "", "length", "place", call<of_node<at>>, nullptr},
        {node, "x", "", "", "length", "x of it", call<of_node<at>, 0>, nullptr},
        {node, "y", "", "", "length", "y of it", call<of_node<at>, 1>, nullptr},
        {node, "z", "", "", "length", "z of it", call<of_node<at>, 2>, nullptr},
        {node, "displacement", "", "", "length", "displacement", call<of_node<shift>>, nullptr},
        {node, "x_displacement", "", "", "length", "x of it", call<of_node<shift>, 0>, nullptr},
        {node, "y_displacement", "", "", "length", "y of it", call<of_node<shift>, 1>, nullptr},
        {node, "z_displacement", "", "", "length", "z of it", call<of_node<shift>, 2>, nullptr},
        {node, "velocity", "", "", "length/time", "velocity", call<of_node<&MemberNodes::velocity>>, set_of_node<&MemberNodes::velocity>},
        {node, "rotation", "", "", "-", "from how it was made: axis times angle in radians, global axes", call<rotation>, nullptr},
        {node, "spin", "", "", "1/time", "rotational velocity", call<of_node<&MemberNodes::spin>>, set_of_node<&MemberNodes::spin>},
        {node, "force", "", "", "force", "on the rock", call<of_node<on_rock>>, nullptr},
        {node, "x_force", "", "", "force", "x of it", call<of_node<on_rock>, 0>, nullptr},
        {node, "y_force", "", "", "force", "y of it", call<of_node<on_rock>, 1>, nullptr},
        {node, "z_force", "", "", "force", "z of it", call<of_node<on_rock>, 2>, nullptr},
        {node, "moment", "", "", "moment", "on the rock; of a clamped node", call<of_node<&MemberNodes::rock_moment>>, nullptr},
        {node, "link_tension", "", "", "-", "of the link along the normal of the face, per area of a liner and length of a beam", call<link_tension_of>, nullptr},
        {node, "link_shear", "", "", "-", "of the link along the face, per area of a liner and length of a beam", call<link_shear_of>, nullptr},
        {node, "link_state", "", "", "-", "1: slips; 2: has slipped; 4: the bond is broken", call<link_state>, nullptr},
        {node, "hold", "", "", "-", "0: lies on no rock; 1: springs; 2: goes with the rock; 3: turns with it too", call<hold>, nullptr},
        {node, "mass", "", "", "mass", "its own", call<mass>, nullptr},
        {node, "inertial_mass", "", "", "mass", "in the equation of motion", call<inertial_mass>, nullptr},

        {beam, "id", "", "", "-", "number, from 1; changes when beams or liners are deleted", call<count_from_one>, nullptr},
        {beam, "structure", "", "", "-", "number of its beam", call<beam_number>, nullptr},
        {beam, "property", "", "", "-", "number of its properties", call<beam_property>, nullptr},
        {beam, "position", "", "", "length", "middle", call<beam_place>, nullptr},
        {beam, "x", "", "", "length", "x of it", call<beam_place, 0>, nullptr},
        {beam, "y", "", "", "length", "y of it", call<beam_place, 1>, nullptr},
        {beam, "z", "", "", "length", "z of it", call<beam_place, 2>, nullptr},
        {beam, "length", "", "", "length", "length", call<beam_length>, nullptr},
        {beam, "axial_force", "", "", "force", "tension positive", call<axial>, nullptr},
        {beam, "shear_y", "", "", "force", "shear force along its axis y", call<shear<0>>, nullptr},
        {beam, "shear_z", "", "", "force", "shear force along its axis z", call<shear<1>>, nullptr},
        {beam, "torsion", "", "", "moment", "about its axis", call<torsion>, nullptr},
        {beam, "moment_y_first", "", "", "moment", "about y at its first node", call<moment<0>>, nullptr},
        {beam, "moment_y_last", "", "", "moment", "about y at its last node", call<moment<1>>, nullptr},
        {beam, "moment_z_first", "", "", "moment", "about z at its first node", call<moment<2>>, nullptr},
        {beam, "moment_z_last", "", "", "moment", "about z at its last node", call<moment<3>>, nullptr},
        {beam, "moment", "", "", "moment", "the largest bending moment of both ends, about any axis", call<largest_moment>, nullptr},
        {beam, "plastic_strain", "", "", "-", "along its axis", call<beam_plastic_strain>, nullptr},
        {beam, "hinge_rotation", "", "", "-", "the largest of its plastic hinges, in radians", call<hinge>, nullptr},
        {beam, "state", "", "", "-", "1: yields; 2: has yielded", call<beam_state>, nullptr},

        {liner, "id", "", "", "-", "number, from 1; changes when beams or liners are deleted", call<count_from_one>, nullptr},
        {liner, "structure", "", "", "-", "number of its liner", call<liner_number>, nullptr},
        {liner, "property", "", "", "-", "number of its properties", call<liner_property>, nullptr},
        {liner, "position", "", "", "length", "centroid", call<liner_place>, nullptr},
        {liner, "x", "", "", "length", "x of it", call<liner_place, 0>, nullptr},
        {liner, "y", "", "", "length", "y of it", call<liner_place, 1>, nullptr},
        {liner, "z", "", "", "length", "z of it", call<liner_place, 2>, nullptr},
        {liner, "area", "", "", "area", "area", call<liner_area>, nullptr},
        {liner, "axis", "", "", "-", "its axis x", call<axis>, nullptr},
        {liner, "normal", "", "", "-", "out of the rock", call<normal>, nullptr},
        {liner, "membrane_xx", "", "", "force/length", "along its axis x; tension positive", call<membrane<0>>, nullptr},
        {liner, "membrane_yy", "", "", "force/length", "along its axis y", call<membrane<1>>, nullptr},
        {liner, "membrane_xy", "", "", "force/length", "shear", call<membrane<2>>, nullptr},
        {liner, "membrane_1", "", "", "force/length", "the greater principal one", call<principal_membrane<0>>, nullptr},
        {liner, "membrane_2", "", "", "force/length", "the smaller principal one: the largest thrust, negative", call<principal_membrane<1>>, nullptr},
        {liner, "moment_xx", "", "", "moment/length", "that bends fibres along its axis x; positive with tension on the side out of the rock", call<plate_moment<0>>, nullptr},
        {liner, "moment_yy", "", "", "moment/length", "the same along its axis y", call<plate_moment<1>>, nullptr},
        {liner, "moment_xy", "", "", "moment/length", "twisting moment", call<plate_moment<2>>, nullptr},
        {liner, "moment_1", "", "", "moment/length", "the greater principal one", call<principal_moment<0>>, nullptr},
        {liner, "moment_2", "", "", "moment/length", "the smaller principal one", call<principal_moment<1>>, nullptr},
        {liner, "greatest_stress", "", "", "stress", "greatest principal stress at both surfaces; tension positive", call<extreme_stress<0>>, nullptr},
        {liner, "least_stress", "", "", "stress", "least principal stress at both surfaces", call<extreme_stress<1>>, nullptr},
    };
    // clang-format on
    return rows;
}

} // namespace kaya::field_rows
