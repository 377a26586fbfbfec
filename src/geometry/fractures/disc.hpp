// Discs of a network of fractures, and what is measured on them.
#pragma once

#include "base/vector.hpp"

#include <algorithm>
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

/// Gives the disc the dip and dip direction of a unit normal, of either sign.
void set_normal(Disc& disc, Vec3 normal);

/// The area of the disc inside an outline in its plane, exact but for rounding.
double area_within(const Disc& disc, const std::vector<Vec3>& outline);

/// The area of the disc inside a box, exact but for rounding.
double area_in_box(const Disc& disc, const Vec3& low, const Vec3& high);

/// Whether the line from `begin` to `end` crosses the disc.
bool crosses(const Disc& disc, const Vec3& begin, const Vec3& end);

/// Fractures along a line, 1/length: how many discs or fractures it crosses, over its length.
template <class Fractures> double p10(const Fractures& fractures, const Vec3& begin, const Vec3& end) {
    const auto count = std::ranges::count_if(fractures, [&](const auto& f) { return crosses(f, begin, end); });
    return static_cast<double>(count) / (end - begin).norm();
}

/// Area of fractures in a box over its volume, 1/length.
template <class Fractures> double p32(const Fractures& fractures, const Vec3& low, const Vec3& high) {
    double area = 0;
    for (const auto& fracture : fractures) area += area_in_box(fracture, low, high);
    return area / (high - low).prod();
}

} // namespace kaya
