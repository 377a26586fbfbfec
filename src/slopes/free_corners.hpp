// A slip surface whose corners move freely: the last part of a search.
#pragma once

#include "slopes/section.hpp"

#include <functional>

namespace kaya {

/// A slip surface and its factor of safety.
struct RatedSurface {
    double factor;
    SlipSurface surface;
};

/// The factor of safety of a surface; `no_answer` where it has none.
struct SurfaceRating {
    std::function<double(const SlipSurface&)> factor;
    double no_answer;
};

/// Moves all corners of a polyline downhill (Subplex of NLopt), its ends along the ground, and adds corners, each where it gains most,
/// until there are `corners` or one more gains less than a thousandth. The surface bends upward only: a body could not move over a corner
/// that points upward. Parts along joints remain on them, since a surface next to a joint does not have the joint's strength. The same
/// surface gives the same answer.
RatedSurface with_free_corners(const SlopeColumns& columns, RatedSurface from, std::size_t corners,
                               const SurfaceRating& rating);

} // namespace kaya
