// The cross product in a plane.
#pragma once

#include <Eigen/Core>

namespace kaya {

/// Twice the area of the triangle of two vectors; positive when b is to the left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

} // namespace kaya
