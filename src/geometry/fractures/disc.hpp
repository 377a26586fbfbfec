// Discs of a network of fractures, and what is measured on them.
#pragma once

#include "base/vector.hpp"

#include <vector>

namespace kaya {

/// A plane round fracture.
struct Disc {
    Vec3 centre = Vec3::Zero();
    double dip = 0, dip_direction = 0; ///< degrees
    double diameter = 1;

    bool operator==(const Disc&) const = default;
};

/// Upward, of unit length.
Vec3 normal_of(const Disc& disc);

/// The disc as a polygon of 32 corners on its rim.
std::vector<Vec3> rim_of(const Disc& disc);

/// The area of the disc inside a box, exact but for rounding.
double area_in_box(const Disc& disc, const Vec3& low, const Vec3& high);

/// Whether the line from `begin` to `end` crosses the disc.
bool crosses(const Disc& disc, const Vec3& begin, const Vec3& end);

/// Fractures along a line, 1/length: how many discs it crosses, over its length.
double p10(const std::vector<Disc>& discs, const Vec3& begin, const Vec3& end);

/// Area of fractures in a box over its volume, 1/length.
double p32(const std::vector<Disc>& discs, const Vec3& low, const Vec3& high);

} // namespace kaya
