// Points with spatially varying distances. Private to geometry.
#pragma once

#include "base/vector.hpp"

#include <functional>
#include <vector>

namespace kaya {

/// A place where edges are short, from which they grow with the distance.
struct FinePlace {
    Vec3 place;
    double edge;
};

/// How far apart points are to be.
struct Spacing {
    std::function<double(const Vec3&)> field; ///< where nothing finer is near
    double change = 0;                        ///< of the field with the distance, at most
    std::vector<FinePlace> finer;

    /// Edges grow by that much with the distance from a finer place.
    static constexpr double growth = 0.35;
};

/// Where points may lie: `clearance` times their edge inside.
struct Room {
    std::function<double(const Vec3&)> depth; ///< below 0 outside, where it changes no more than the distance does
    double clearance;
};

/// Lattice points of many sizes in a box, each where its size is required, and none too near to another. A body-centred cubic lattice; a
/// triangular one in a box without height.
std::vector<Vec3> graded_points(const Vec3& low, const Vec3& high, const Spacing& spacing, const Room& room);

} // namespace kaya
