// Fractures that nearly lie in one plane are put into one plane.
#pragma once

#include "geometry/fractures/fracture.hpp"

#include <cstddef>
#include <vector>

namespace kaya {

/// When a smaller fracture belongs to the plane of a larger one, and what happens to it.
struct Combining {
    double angle = 0;    ///< degrees: the greatest between both planes
    double distance = 0; ///< the greatest of its centre from the plane of the larger one
    enum class Joining {
        turn,     ///< it gets the direction of the larger one
        collapse, ///< and its plane
        merge,    ///< it is turned, and moved if it then overlaps the larger one, which takes up its area
        hull      ///< as merge, but the larger one becomes the convex hull of both
    } joining = Joining::turn;
    int sides = 12; ///< hull: of the regular polygon, equal in area, that stands for a disc
};

struct Combined {
    std::size_t turned = 0, moved = 0;          ///< `moved` are also turned
    std::vector<const Fracture*> taken_up = {}; ///< by merge and hull: they are to be deleted
};

/// From the largest fracture to the smallest, of equal ones by number: each that was not turned itself collects smaller ones that were
/// neither. A fracture that takes up one inside of it stays as it is. Otherwise, with merge, it grows about its centre to the area of both.
Combined combine(const std::vector<Fracture*>& fractures, const Combining& how);

} // namespace kaya
