// Where the eye stands, such that the model fills a part of the picture.
#pragma once

#include "scene/scene.hpp"

#include <array>

namespace kaya {

/// A part of the picture, in pixels from its lower left corner.
struct Area {
    double left = 0, bottom = 0, right = 1, top = 1;
};

/// A view of the model. All vectors have length 1.
struct Framing {
    std::array<double, 3> right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1}; ///< of the picture; `toward` the eye
    std::array<double, 3> focus{0, 0, 0};                               ///< is drawn in the middle of the area
    double distance = 1;                                                ///< from the focus to the eye
    double pixel = 1; ///< length of a pixel in the plane through the focus
};

/// The angle under which the height of the picture is seen, in degrees.
constexpr double view_angle = 25;

/// Nearest view by the scene's direction in which all points of its layers are within the area; then its centre and magnification apply.
/// Exact: each edge of the area bounds the eye's place by the greatest of linear functions of the points.
Framing framing_of(const Scene& scene, const Area& area);

} // namespace kaya
