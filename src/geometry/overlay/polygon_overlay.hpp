// The intersection of two convex polygons in a plane, and the places that represent it in a joint between rigid blocks.
#pragma once

#include "geometry/overlay/overlay_scratch.hpp"

#include <vector>

namespace kaya {

/// The intersection of two convex polygons, anticlockwise; both may have any sense. Points nearer than `tolerance` are merged; a thinner
/// part is dropped.
void common_polygon(const std::vector<Vec2>& one, const std::vector<Vec2>& two, double tolerance,
                    std::vector<Vec2>& common, OverlayScratch& scratch);

/// Places and areas of a polygon: its corners, and four places inside. Sums of area, area x and area x x' are the integrals over the polygon
/// to rounding, and so is the sum of area and distance from the centre. So linear springs on the areas resist closing and tilting as the
/// continuous joint does, and friction resists twisting, for any polygon and any order of its corners. With `edge` above 0 the distance of
/// places is about `edge`. Only place and area of the points are set.
void points_of_polygon(const std::vector<Vec2>& polygon, double edge, double tolerance, Overlay& result,
                       OverlayScratch& scratch);

/// Corners only, each with its third of the triangles around it: the mean over the fans from all corners, so that no corner is preferred.
/// Sums of area and area x are exact; second moments are too large, three times those of a parallelogram.
void corners_of_polygon(const std::vector<Vec2>& polygon, Overlay& result);

} // namespace kaya
