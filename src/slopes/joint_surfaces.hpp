// Slip surfaces that follow joints and weak layers: the block search.
#pragma once

#include "slopes/free_corners.hpp"

#include <vector>

namespace kaya {

/// The weakest of surfaces along one joint of the section, or the base of a weak layer, that leave it at either end along another, on a straight leg to the
/// ground, or where it comes to daylight; the weakest first. The longest joints are looked at.
std::vector<RatedSurface> weakest_along_joints(const SlopeColumns& columns, const SurfaceRating& rating);

} // namespace kaya
