// Cuts a convex polyhedron by a plane.
#pragma once

#include "geometry/polyhedra/plane.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

namespace kaya {

enum class CutOutcome {
    cut,    ///< two pieces
    above,  ///< the plane misses; all of the polyhedron is on the side of the normal
    below,  ///< no intersection; all of it is on the other side
    sliver, ///< refused: a piece would be thinner than allowed
    corner, ///< refused: it would pass too near to a vertex
};

struct Cut {
    CutOutcome outcome = CutOutcome::cut;
    Polyhedron above; ///< on the side of the normal; empty unless cut
    Polyhedron below; ///< on the other side; empty unless cut
};

/// Cuts by `plane`. The two pieces have the cut as their last face, with the same vertices bit for bit and in opposite order; the face
/// stores `joint_set`. The intersection of an edge with the plane depends on the ends of the edge and on the plane alone, so neighbours
/// keep sharing edges. A piece thinner than `thinnest` is not created (outcome sliver) and the polyhedron stays whole; so it does where a
/// vertex is nearer to the plane than `nearest` and not on it, or an edge of the cut would be shorter than that (outcome corner): no piece
/// gets a new edge shorter than `nearest`.
Cut cut(const Polyhedron& polyhedron, const Plane& plane, int joint_set, double thinnest = 0, double nearest = 0);

/// The same with vertices up to `band` from the plane taken as lying on it: for pieces of planes that meet at small angles, whose vertices
/// are known to no better than that.
Cut cut_with_band(const Polyhedron& polyhedron, const Plane& plane, double band);

/// The planes of the faces, looking outward.
std::vector<Plane> outer_planes(const Polyhedron& polyhedron);

/// The corners of the cut on one of the pieces.
std::vector<Vec3> section_of(const Polyhedron& piece);

/// The least distance between a face and the vertex farthest from it: the thickness of a plate, the
/// smaller side of a needle. Zero for a polyhedron without faces.
double thickness(const Polyhedron& polyhedron);

} // namespace kaya
