// Solids that a deck names by their shape.
#pragma once

#include "geometry/surface/surface.hpp"

#include <array>

namespace kaya {

/// Two polygons with matching corners, joined side by side. Sides that are warped become two triangles
/// each; the polygons themselves must be flat. A corner that both polygons share makes a wedge.
/// Throws Diagnostic: different numbers of corners, sides that cross each other, no volume.
Solid make_prism(const std::vector<Vec3>& first, const std::vector<Vec3>& second);

/// Any polyhedron from its faces, corners in order around each face, in either direction. `joint_sets` gives the joint set of each face, or
/// is empty.
Solid make_from_faces(const std::vector<std::vector<Vec3>>& loops, const std::vector<int>& joint_sets = {},
                      const Flatness& flatness = {});

/// Throws Diagnostic when the four corners lie in one plane.
Polyhedron make_tetrahedron(const std::array<Vec3, 4>& corners);

Polyhedron make_cube(const Vec3& centre, double edge);

/// A round column, or a cone when one radius is 0, with `sides` flat sides.
struct Drum {
    Vec3 end1 = Vec3::Zero(), end2 = Vec3::UnitZ();
    double radius1 = 1, radius2 = 1;
    int sides = 8;
};
Polyhedron make_drum(const Drum& drum);

/// Blocks around a round hole, within a square outline; nothing in the hole.
struct TunnelBlocks {
    double dip = 0, dip_direction = 0; ///< of the axis, degrees; 0 0 is a level axis to the north
    Vec3 origin = Vec3::Zero();
    double radius = 1;
    double begin = -10, end = 10;              ///< along the axis, from the origin
    int radial = 1, tangential = 1, axial = 1; ///< blocks; tangential within each 45 degrees
    double boundary = 4;                       ///< from the wall to the outline, in radii
    double ratio = 1;                          ///< thickness of each ring over that of the ring inside it
};
std::vector<Polyhedron> make_tunnel(const TunnelBlocks& tunnel);
/// The rock in the tunnel: a prism for each slice along the axis, whose sides are faces of the first ring of blocks.
std::vector<Polyhedron> make_tunnel_core(const TunnelBlocks& tunnel);

} // namespace kaya
