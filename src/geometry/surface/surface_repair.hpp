// Surfaces of other programs as they are: double walls, corners that nearly meet, cracks, holes.
#pragma once

#include "geometry/surface/surface.hpp"

namespace kaya {

/// Tolerances of the repair, beyond the digits of the file.
struct Repair {
    double near = 0; ///< corners, and corners and edges, nearer than this are joined; a length, 0: none
    double hole = 0; ///< holes no wider than this are closed; a length, 0: none
};

struct RepairCounts {
    int doubled = 0;  ///< faces that lay on others
    int welded = 0;   ///< corners joined to others
    int inserted = 0; ///< corners put on edges of faces that lacked them
    int closed = 0;   ///< holes
    int narrow = 0;   ///< faces that were narrower than the tolerance
};

/// Drops faces that lie on others, corner by corner: of a face that is there twice one remains if that closes its edges, none if the two
/// are the inner walls of joined parts.
void drop_doubled_faces(Surface& surface, RepairCounts& counts);

/// Joins what is nearer than `repair.near` and closes holes. Corners have been merged already.
void repair_surface(Surface& surface, const Repair& repair, RepairCounts& counts);

} // namespace kaya
