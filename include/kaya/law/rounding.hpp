/* SPDX-License-Identifier: MIT */
// Rounding of the distance between the two sides of a joint.
#pragma once

#include <cmath>

namespace kaya::joints {

/// Whether a gap or a closure of a sub-contact of this area is more than rounding, of coordinates and of motions that are alike: above 1e-9 of its
/// size. Less breaks no bond, and mobilises no strength.
[[gnu::always_inline]] inline bool beyond_rounding(double distance, double area) {
    constexpr double part = 1e-9;
    return distance * std::abs(distance) > part * part * area; // one comparison: loops over rows stay vectors
}

} // namespace kaya::joints
