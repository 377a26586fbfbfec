// Triangles, lines and tetrahedra with a value at each corner, cut by a plane.
#pragma once

#include "pictures/model_picture.hpp"

#include <array>
#include <vector>

namespace kaya {

struct Corner {
    Vec3 place = Vec3::Zero();
    float value = 0;
};
using Polygon = std::vector<Corner>;

/// The part of a convex polygon that is kept, corners in order; empty when none is.
Polygon kept_part(const Polygon& polygon, const CutPlane& plane);
/// The part of a line that is kept: two ends or none.
Polygon kept_line(const Corner& from, const Corner& to, const CutPlane& plane);
/// The corners, in order, of the face that the plane makes in a tetrahedron.
Polygon slice_of(const std::array<Corner, 4>& tetrahedron, const CutPlane& plane);
/// Sorts the points of a convex face around their middle.
void put_in_order(Polygon& points, const Vec3& normal);

void add_polygon(Layer& layer, const Polygon& polygon);
void add_line(Layer& layer, const Corner& from, const Corner& to);

} // namespace kaya
