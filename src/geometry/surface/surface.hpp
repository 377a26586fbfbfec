// A closed surface given by users: faces of either orientation, perhaps not quite flat, perhaps concave.
#pragma once

#include "geometry/polyhedra/polyhedron.hpp"

#include <string>
#include <vector>

namespace kaya {

struct Surface {
    struct Face {
        std::vector<int> vertices; ///< in order around the face, in either direction
        int joint_set = 0;
        std::string name; ///< as messages call it: "face 3"
    };
    std::vector<Vec3> vertices;
    std::vector<Face> faces;
};

/// Treatment of faces that are not flat. Lengths are relative to the surface's size (the diagonal of its box).
struct Flatness {
    double mended = 1e-3;          ///< smaller warp is removed by moving vertices
    bool triangulate_rest = false; ///< faces warped more become triangles; otherwise they are refused
    double triangulated = 0;       ///< otherwise, faces with smaller warp become triangles
    double merged =
        1e-6; ///< neighbours whose corners lie no farther off a common plane are one face; the digits of single precision
};

/// A solid as convex parts: one for a convex body, several for a concave one.
struct Solid {
    std::vector<Polyhedron> parts;
    int turned_faces = 0;                  ///< faces given in the opposite direction of the first
    bool anticlockwise = false;            ///< all faces were given anticlockwise seen from outside
    std::vector<std::string> triangulated; ///< faces that became triangles because they are warped
    double mended_by = 0;                  ///< largest displacement of a vertex that made faces flat, a length
};

/// Diagonal of the box around the vertices: the size of a surface.
double size_of(const std::vector<Vec3>& vertices);

/// Joins corners nearer to each other than `near` (a length) and names the faces "face 1", ...
Surface surface_from_loops(const std::vector<std::vector<Vec3>>& loops, double near);

/// The separate closed surfaces, in the order of their first faces. Surfaces that meet in an edge are separate; so are walls that lie on
/// each other.
std::vector<Surface> separate(const Surface& surface);

/// Checks and repairs one closed surface, orients its faces outward and splits it when concave; what the cavities, closed surfaces inside
/// it, enclose is hollow. The parts do not depend on the order of faces. Throws Diagnostic that names the face: repeated, open, without
/// area, crossing itself or another, warped.
Solid solid_from_surface(const Surface& surface, const Flatness& flatness = {},
                         const std::vector<Surface>& cavities = {});

} // namespace kaya
