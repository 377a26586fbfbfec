// Whether a rigid block that cannot slide rotates out of its place.
#pragma once

#include "base/vector.hpp"
#include "slopes/strength.hpp"

#include <optional>
#include <span>

namespace kaya {

/// A corner of a face on which a block rests, and its share of the face.
struct RestingCorner {
    Vec3 outward = Vec3::Zero(); ///< unit, into the other body
    Vec3 arm = Vec3::Zero();     ///< from the reference point of moments
    double area = 0;
    Coulomb strength; ///< none: neither cohesion nor friction
};

/// The factor by which the strength of all corners can be divided until normal and shear forces there no longer balance a force and its
/// moment: 0 where balance needs shear that they do not have, none where no shear is needed. A force that no strength balances has factor
/// 0.
std::optional<double> turning_factor(const Vec3& force, const Vec3& moment, std::span<const RestingCorner> corners);

} // namespace kaya
