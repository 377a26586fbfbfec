/* SPDX-License-Identifier: MIT */
// What is rounding between the sides of a joint.
#pragma once

namespace kaya::joints {

/// Whether a gap or a closure of a sub-contact of this area is more than rounding, of coordinates and of motions that are alike: above 1e-9 of its
/// size. Less breaks no bond, and mobilises no strength.
[[gnu::always_inline]] inline bool beyond_rounding(double distance, double area) {
    constexpr double part = 1e-9;
    return distance > 0 && distance * distance > part * part * area;
}

} // namespace kaya::joints
