// Slip surfaces that follow joints and weak layers: the block search.
#pragma once

#include "slopes/free_corners.hpp"

#include <vector>

namespace kaya {

/// The weakest surfaces along one joint of the section, or along the base of a weak layer. They leave it at either end along another joint,
/// on a straight leg to the ground, or where it daylights; the weakest first. Only the longest joints are searched.
std::vector<RatedSurface> weakest_along_joints(const SlopeColumns& columns, const SurfaceRating& rating);

} // namespace kaya
