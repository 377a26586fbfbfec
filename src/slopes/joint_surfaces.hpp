// Slip surfaces that follow joints and weak layers: the block search.
#pragma once

#include "slopes/section.hpp"

#include <functional>
#include <optional>

namespace kaya {

struct JointSurface {
    double factor;
    SlipSurface surface;
};

/// The weakest of surfaces along one joint of the section, or the base of a weak layer, that leave it at either end along another, on a straight leg to the
/// ground, or where it comes to daylight. `factor` gives a surface's factor of safety, and `no_answer` or more when it has none. The longest
/// of them are looked at.
std::optional<JointSurface> weakest_along_joints(const SlopeColumns& columns, double no_answer,
                                                 const std::function<double(const SlipSurface&)>& factor);

} // namespace kaya
