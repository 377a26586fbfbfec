// Scratch memory for consecutive overlays: a contact search makes very many.
#pragma once

#include "geometry/overlay/overlay.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace kaya {

/// Scratch memory of the functions below: no result depends on it.
struct OverlayScratch {
    /// A line through a point, with its direction of length 1; a line too short to have one is 0.
    struct Line {
        Vec2 point = Vec2::Zero(), along = Vec2::Zero();
    };
    /// A triangle of a side with its corners in anticlockwise order and its extent.
    struct SweepItem {
        Vec2 low, high;
        std::array<Vec2, 3> corners;
        std::array<Line, 3> sides; ///< of the side that cuts the other
        int triangle;

        SweepItem(const PlaneMesh& mesh, int t);
        void find_sides(double tolerance);
    };
    /// Four points, one in each lane of a vector register; missing ones have no weight.
    struct SampleGroup {
        static constexpr std::size_t size = 4;
        using Four = Eigen::Array4d;
        Four weight, u, v;
        std::array<Four, 3> f;
        Four change; ///< of their areas, in parts of them
    };

    std::vector<std::pair<double, int>> order;
    std::vector<SweepItem> sweep1, sweep2;
    std::vector<int> ring, opposite_triangles;
    std::vector<SampleGroup> samples;
    std::vector<double> heights; ///< of the corners of a polygon that is clipped
    std::vector<Vec2> left;      ///< of it
};

/// As in overlay.hpp, which allocate their own memory.
void overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge, Overlay& result,
             OverlayScratch& scratch);
void balance_areas(Overlay& overlay, OverlayScratch& scratch);

} // namespace kaya
