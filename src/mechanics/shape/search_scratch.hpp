// Scratch memory for the geometry of consecutive contacts.
#pragma once

#include "geometry/overlay/overlay_scratch.hpp"
#include "mechanics/shape/flat_face.hpp"
#include "mechanics/shape/overlap_scratch.hpp"
#include "mechanics/shape/separation.hpp"

#include <array>
#include <utility>
#include <vector>

namespace kaya {

/// Scratch memory of the search: no result depends on it.
struct SearchScratch {
    SeparationScratch separation;
    OverlayScratch overlay;
    OverlapScratch overlap;
    Overlay found;
    std::array<FlatFace, 2> faces;
    std::array<std::vector<Vec2>, 2> outlines;
    std::vector<Vec2> common;                                ///< to both outlines
    std::vector<double> shares;                              ///< of points in the blocks' surfaces
    std::vector<double> parts;                               ///< of points of two overlays in their places
    std::vector<std::pair<Vec2, std::size_t>> places, order; ///< of points of overlays, as made and in order
};

} // namespace kaya
