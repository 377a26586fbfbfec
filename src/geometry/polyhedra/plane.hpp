// A plane, and the plane that dip and dip direction describe.
#pragma once

#include "base/vector.hpp"

namespace kaya {

struct Plane {
    Vec3 normal = Vec3::UnitZ(); ///< of unit length
    Vec3 origin = Vec3::Zero();

    /// Positive on the side that the normal points to.
    double distance(const Vec3& point) const { return normal.dot(point - origin); }
};

/// Upward unit normal (sin dip sin dd, sin dip cos dd, cos dip); x east, y north, z up, degrees.
/// Multiples of 30 and 45 degrees give the exact zeros, halves and ones that a user expects.
Vec3 normal_from_dip(double dip, double dip_direction);

} // namespace kaya
