// Places and sets of plane polygons: how many a ray crosses, and how far away they are.
#pragma once

#include "commands/ranges/flat_figure.hpp"
#include "commands/ranges/surface_sets.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Rays in one direction. A ray through the common edge of two polygons crosses one of them: projections of one corner are the same numbers.
class SurfaceRays {
public:
    /// `direction` has the length 1. Polygons without area, and those that the direction lies in, are not crossed.
    SurfaceRays(const PolygonSet& polygons, const Vec3& direction);

    /// Polygons that the ray from a place crosses.
    int crossings(const Vec3& place) const;

private:
    struct Outline {
        std::vector<Eigen::Vector2d> corners; ///< seen along the direction
        Eigen::Vector2d low, high;
        double base;           ///< where its plane is along the direction, at the origin
        Eigen::Vector2d slope; ///< and how that changes
    };
    Vec3 direction_, across_, along_;
    std::vector<Outline> outlines_;
};

class SurfaceDistance {
public:
    explicit SurfaceDistance(const PolygonSet& polygons);

    /// Whether a polygon is within the distance.
    bool within(const Vec3& place, double distance) const;

private:
    struct Figure {
        FigurePlane plane;
        std::vector<Eigen::Vector2d> outline;
        Vec3 low, high;
    };
    std::vector<Figure> figures_;
};

} // namespace kaya
