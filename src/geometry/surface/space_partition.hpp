// Dividing space by the planes of faces (binary space partition: Fuchs, Kedem and Naylor 1980). Private to geometry.
#pragma once

#include "geometry/polyhedra/plane.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <vector>

namespace kaya {

/// A convex piece of a face.
struct Fragment {
    std::vector<Vec3> corners;
    Plane plane;
    std::size_t face = 0; ///< pieces of one face follow each other
};

/// A convex piece of space with the faces in it.
struct Cell {
    Polyhedron space;
    std::vector<Fragment> fragments;
};

/// The part of the polygon on the side `sign` of the plane.
std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Plane& plane, double sign);

struct Sides {
    std::vector<Fragment> front, back;
};

/// The fragments on both sides of the plane, cut by it. Those in the plane, nearer than `near`, are left out.
Sides sort_sides(const std::vector<Fragment>& fragments, const Plane& plane, double near);

/// The planes that split the fewest faces, in the order of these; parallel ones once.
std::vector<Plane> best_planes(const std::vector<Fragment>& fragments, double near);

} // namespace kaya
