// Block theory: whether a rigid block can be removed without rotation, and its resistance.
#pragma once

#include "base/vector.hpp"
#include "slopes/strength.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace kaya {

/// A plane part of the block's surface in contact with another body.
struct HeldFace {
    Vec3 outward = Vec3::Zero(); ///< unit, into the other body
    double area = 0;
    const Strength* strength = nullptr; ///< null: none at all
};

enum class SlidingMode {
    held,    ///< no direction is free: the block is tapered or enclosed
    at_rest, ///< it could leave, but the force presses it against its faces
    falling, ///< away from all faces
    one_plane,
    two_planes, ///< along their line of intersection
    turning,    ///< out of its place, since its faces cannot balance the moment; slides nowhere (see turning.hpp)
};

struct SlidingAnswer {
    SlidingMode mode = SlidingMode::held;
    Vec3 direction = Vec3::Zero();  ///< unit vector of the motion without friction
    std::vector<std::size_t> faces; ///< on which it slides
    std::optional<double> factor;   ///< strength over driving force; 0 when it falls; none without a driving force
};

/// A block under a force (weight, water on its faces, loads). Moments are ignored: toppling is not detected. The direction is the one
/// nearest to the force among those that leave no face penetrated (Goodman and Shi 1985; Warburton 1981).
SlidingAnswer slide(const Vec3& force, std::span<const HeldFace> faces);

} // namespace kaya
