// The steps from a surface as given to a closed one with flat, outward faces. Private to geometry.
#pragma once

#include "geometry/surface/surface.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace kaya {

/// A surface with more faces than this is a fine mesh, not drawn face by face.
inline constexpr std::size_t fine_net = 1000;

/// Leaves out corners that repeat their neighbour and vertices that no face uses. Refuses faces that
/// then have less than three corners or no area, name a corner twice, or repeat another face.
void check_faces(Surface& surface);

/// Whether an even number of faces meets in each edge.
bool is_closed(const Surface& surface);

/// Gives all faces the orientation of the first one; returns how many were turned. Refuses open edges, edges of more than two faces, and
/// unconnected surfaces.
int turn_alike(Surface& surface);

/// The same for a surface with a rim: its edges that belong to one face. Refuses edges of more than two faces, and unconnected surfaces.
std::vector<std::array<Vec3, 2>> turn_open_alike(Surface& surface);

/// Turns all faces outward when they are inward; returns whether they were. Refuses a surface without volume.
bool turn_outward(Surface& surface);

/// The warp of a face: greatest distance of its vertices from its mean plane.
double warp(const Surface& surface, const Surface::Face& face);

/// Merges coplanar neighbouring faces of one joint set, as found in triangulated files; drops corners inside edges.
void merge_flat_neighbours(Surface& surface, const Flatness& flatness);

/// How many corners further than usual the division of a warped face begins, by the face's name: it has other diagonals then.
using Diagonals = std::map<std::string, int>;

/// Makes faces flat by moving vertices, or splits them, or refuses. Returns the longest move.
double flatten(Surface& surface, const Flatness& flatness, const Diagonals& diagonals,
               std::vector<std::string>& triangulated);

/// The order of places: by x, then y, then z.
bool comes_first(const Vec3& a, const Vec3& b);

/// Sorts vertices by place, loops and faces by vertices: what is made of the surface then depends on its shape alone.
void put_in_order(Surface& surface);

/// Refuses faces whose outline crosses itself.
void check_outlines(const Surface& surface);

/// Names of faces that cross each other, by pairs. Throws Diagnostic where faces meet in a corner or an edge alone.
std::vector<std::pair<std::string, std::string>> crossing_faces(const Surface& surface);

bool is_convex(const Surface& surface, double tolerance);

/// Triangles (indices of vertices) that cover a flat simple polygon, which need not be convex.
std::vector<std::array<int, 3>> triangles_of(const std::vector<Vec3>& vertices, const Surface::Face& face);

struct ConvexSplit {
    std::vector<Polyhedron> parts;
    std::optional<Vec3>
        crossed_at; ///< a point that the surface winds around more than once, or inside out; the parts are incomplete then
};

/// Convex parts of a closed surface with flat outward faces. Throws Diagnostic when they miss its volume.
ConvexSplit convex_parts(const Surface& surface);

/// Unit normal (Newell) and a point of the mean plane of a face.
Vec3 mean_normal(const std::vector<Vec3>& vertices, const std::vector<int>& loop);
Vec3 mean_point(const std::vector<Vec3>& vertices, const std::vector<int>& loop);
inline Vec3 mean_normal(const Surface& surface, const Surface::Face& face) {
    return mean_normal(surface.vertices, face.vertices);
}
inline Vec3 mean_point(const Surface& surface, const Surface::Face& face) {
    return mean_point(surface.vertices, face.vertices);
}

} // namespace kaya
