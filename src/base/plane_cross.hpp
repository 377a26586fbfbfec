// The cross product in a plane.
#pragma once

#include <Eigen/Core>

namespace kaya {

/// Twice the area of the triangle of two vectors; above 0 when b lies to the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

} // namespace kaya
