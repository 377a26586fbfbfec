// The slip surface with the least factor of safety.
#pragma once

#include "slopes/section.hpp"

#include <array>
#include <optional>

namespace kaya {

struct SurfaceSearch {
    SliceMethod method = SliceMethod::spencer; ///< of the last search; the first one rates circles with bishop
    int slices = 30;
    std::optional<std::array<double, 2>> entry,
        exit;               ///< ranges of the upper and the lower end along the section; not given: anywhere
    int corners = 8;        ///< of a polyline, the ends included
    double least_depth = 0; ///< length; shallower surfaces are left out
};

struct FoundSurface {
    SlipSurface surface;
    SliceAnswer answer;
};

/// Circles over a net of both ends and the depth between them, then from the weakest of these on downhill. None when no
/// circle has an answer. The same section gives the same circle.
std::optional<FoundSurface> weakest_circle(const SlopeColumns& columns, const SurfaceSearch& search);

/// Polylines that bend upward only: from the weakest circles on, and by a controlled random search (CRS2 of NLopt, from a
/// fixed seed), then downhill; and surfaces that follow joints (joint_surfaces.hpp). All corners of the weakest of these then move freely (free_corners.hpp).
std::optional<FoundSurface> weakest_polyline(const SlopeColumns& columns, const SurfaceSearch& search);

} // namespace kaya
