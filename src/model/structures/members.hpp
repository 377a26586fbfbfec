// Beams and liners: bars and plates on the faces of blocks, whose nodes have inertia. docs/theory/beams-and-liners.md.
#pragma once

#include "geometry/surface/surface_mesh.hpp"
#include "model/tables/member_tables.hpp"
#include "model/measure/structure_rows.hpp"
#include "model/structures/rock_points.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

struct Model;

/// A beam to be created: a polyline.
struct NewBeam {
    std::vector<Vec3> places;
    std::int32_t segments = 10; ///< elements of each straight part
    std::int32_t property = 1;
    Vec3 axis = Vec3::Zero(); ///< 0: global y, or x for a beam along y
    double tolerance = 0;
    Grip grip = Grip::link, first = Grip::link, last = Grip::link; ///< of all nodes; of the ends
};

/// A liner to be made.
struct NewLiner {
    SurfaceMesh mesh;
    std::int32_t property = 1;
    Vec3 axis = Vec3::Zero(); ///< 0: global x, or y where that is nearly normal to the element
    double tolerance = 0;
    Grip grip = Grip::link;
};

/// Make them and place their nodes in the blocks. Return the row. Neighbouring places must differ.
Row make_beam(Model& model, const NewBeam& wanted);
Row make_liner(Model& model, const NewLiner& wanted);

/// Removes members, given by ascending rows.
void delete_members(Model& model, const std::vector<Row>& members);

/// Places nodes again whose block was deleted or changed its shape. Their forces on it are dropped.
void place_member_nodes(Model& model, const BlockFinder& finder);

/// The present attachment of a node to the rock.
enum class Hold : std::uint8_t { none, springs, pinned, clamped };
Hold hold_of(const Model& model, Row node);

/// The x direction of a liner on an element: the wanted one, or global x, without its part along the normal.
Vec3 liner_axis(const Vec3& wanted, const Vec3& normal);

/// The present normal of a node.
Vec3 normal_of_node(const Model& model, Row node);

/// Forces of the link of the node, per area of a liner and length of a beam: away from the rock, and along the face.
double link_tension_of(const Model& model, Row node);
double link_shear_of(const Model& model, Row node);

} // namespace kaya
