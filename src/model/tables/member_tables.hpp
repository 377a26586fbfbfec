// Tables of beams and liners, of their nodes and elements. docs/theory/beams-and-liners.md.
#pragma once

#include "model/tables/rock_columns.hpp"

namespace kaya {

class MemberNodes;
class BeamElements;
class LinerElements;

/// One of them for each `structure beam` and `structure liner`.
class Members : public Table<Members> {
public:
    Column<std::int32_t> number;   ///< what users see, one count with cables
    Column<std::int32_t> property; ///< key of Structures::properties
    Column<std::uint8_t> kind;     ///< StructureKind
    Column<Vec3> axis;             ///< of a beam: about where its axis y points; of a liner: its axis x
    Column<double> tolerance;      ///< distance outside the rock at which a node still lies on it
    Column<Span> nodes;            ///< contiguous and in the order of members, as the elements
    Column<Span> beams;
    Column<Span> liners;

    template <class Visit> void columns(Visit&& visit) {
        visit("number", number, Role::identity);
        visit("property", property, Role::setting);
        visit("kind", kind, Role::setting);
        visit("axis", axis, Role::setting);
        visit("tolerance", tolerance, Role::setting);
        visit("nodes", nodes, link<MemberNodes>());
        visit("beams", beams, link<BeamElements>());
        visit("liners", liners, link<LinerElements>());
    }
};

/// Additional restraint of a node.
enum class Grip : std::uint8_t {
    link,   ///< as its properties say
    anchor, ///< it moves with the rock
    clamp   ///< and turns with it
};

class MemberNodes : public Table<MemberNodes>, public RockPoints {
public:
    Column<Row> member;
    Column<Grip> grip;
    Column<Vec3> reference;       ///< place when it was made, without force
    Column<Vec3> normal;          ///< of its face, out of the rock, at creation; 0: on no face
    Column<double> share;         ///< of the area of a liner, of the length of a beam
    Column<Vec3> rock;            ///< place of the rock at the node
    Column<Vec3> rock_shift;      ///< displacement of the rock in small strain, of saves that do not have it in `local`
    Column<Quaternion> rock_turn; ///< of a clamped node in the axes of its block
    Column<Vec3> position;
    Column<Quaternion> rotation; ///< from how it was made
    Column<Vec3> velocity;
    Column<Vec3> spin;
    Column<Vec3> displacement;
    Column<double> mass;
    Column<double> inertial_mass;      ///< in the equation of motion
    Column<double> inertia;            ///< the same for rotations, about all axes
    Column<double> stiffness;          ///< bound of that of its elements and its link: equation (14)
    Column<double> rotation_stiffness; ///< the same of rotations
    Column<Vec3> force;                ///< of elements, link and weight
    Column<Vec3> moment;
    Column<Vec3> last_force; ///< one step ago, for combined damping
    Column<Vec3> last_moment;
    Column<Vec3> rock_force; ///< of the node on the rock
    Column<Vec3> rock_moment;
    Column<Vec3> link_slip; ///< from the rock to where the link has no force, in the node's own axes
    Column<std::uint8_t> link_state;

    template <class Visit> void columns(Visit&& visit) {
        visit("member", member, link<Members>());
        rock_columns(visit);
        visit("grip", grip, Role::setting);
        visit("reference", reference, Role::geometry);
        visit("normal", normal, Role::geometry);
        visit("share", share, Role::geometry);
        visit("rock", rock, Role::geometry);
        visit("rock_shift", rock_shift, Role::geometry);
        visit("rock_turn", rock_turn, Role::geometry);
        visit("position", position, Role::geometry);
        visit("rotation", rotation, Role::geometry);
        visit("velocity", velocity, Role::motion);
        visit("spin", spin, Role::motion);
        visit("displacement", displacement, Role::displacement);
        visit("mass", mass, Role::geometry);
        visit("inertial_mass", inertial_mass, Role::geometry);
        visit("inertia", inertia, Role::geometry);
        visit("stiffness", stiffness, Role::geometry);
        visit("rotation_stiffness", rotation_stiffness, Role::geometry);
        visit("force", force, Role::state);
        visit("moment", moment, Role::state);
        visit("last_force", last_force, Role::state);
        visit("last_moment", last_moment, Role::state);
        visit("rock_force", rock_force, Role::state);
        visit("rock_moment", rock_moment, Role::state);
        visit("link_slip", link_slip, Role::state);
        visit("link_state", link_state, Role::state);
    }
};

/// Parts of beams between two nodes. Forces are those on the section face towards the last node.
class BeamElements : public Table<BeamElements> {
public:
    Column<Row> member;
    Column<std::array<Row, 2>> nodes;
    Column<Vec3> axis_y;                  ///< when it was made
    Column<double> extension_lost;        ///< plastic part
    Column<std::array<double, 4>> hinges; ///< rotations: about y at the first and the last node, about z at both
    Column<std::array<double, 6>> kept; ///< forces without deformation, of stiffnesses before: axial, torsion, moments
    Column<double> axial;               ///< tension positive
    Column<double> torsion;
    Column<std::array<double, 2>> shear;   ///< y, z
    Column<std::array<double, 4>> moments; ///< as hinges
    Column<std::uint8_t> state;

    template <class Visit> void columns(Visit&& visit) {
        visit("member", member, link<Members>());
        visit("nodes", nodes, link<MemberNodes>());
        visit("axis_y", axis_y, Role::geometry);
        visit("extension_lost", extension_lost, Role::state);
        visit("hinges", hinges, Role::state);
        visit("kept", kept, Role::state);
        visit("axial", axial, Role::state);
        visit("torsion", torsion, Role::state);
        visit("shear", shear, Role::state);
        visit("moments", moments, Role::state);
        visit("state", state, Role::state);
    }
};

/// Triangles of liners, anticlockwise seen from outside of the rock. Per length, in the member's axes on the element: xx, yy, xy.
class LinerElements : public Table<LinerElements> {
public:
    Column<Row> member;
    Column<std::array<Row, 3>> nodes;
    Column<Vec3> axis;   ///< x, now
    Column<Vec3> normal; ///< now
    /// Resultants without deformation, of stiffnesses before, in the element's own axes: membrane, moments at the middles of the three
    /// sides, and of the nodes about the normal.
    Column<Eigen::Matrix<double, 3, 5>> kept;
    Column<Vec3> membrane; ///< tension positive
    Column<Vec3> moment;   ///< positive with tension on the side facing away from the rock

    template <class Visit> void columns(Visit&& visit) {
        visit("member", member, link<Members>());
        visit("nodes", nodes, link<MemberNodes>());
        visit("axis", axis, Role::geometry);
        visit("normal", normal, Role::geometry);
        visit("kept", kept, Role::state);
        visit("membrane", membrane, Role::state);
        visit("moment", moment, Role::state);
    }
};

} // namespace kaya
