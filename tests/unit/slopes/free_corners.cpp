#include "slopes/free_corners.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya {
namespace {

/// A cut of 10 m and 45 degrees, from the toe at 0.
SlopeSection cut_slope() {
    SlopeSection section;
    section.strengths = {Strength::coulomb(12e3, 20), Strength::coulomb(0, 5)};
    section.cells = {{{{-20, -10}, {-20, 0}, {0, 0}, {0, -10}}, 20e3, 0},
                     {{{0, -10}, {0, 0}, {10, 10}, {10, -10}}, 20e3, 0},
                     {{{10, -10}, {10, 10}, {50, 10}, {50, -10}}, 20e3, 0}};
    return section;
}

constexpr double no_answer = 1e6;

SurfaceRating by_spencer(const SlopeColumns& columns) {
    return {[&columns](const SlipSurface& surface) {
                const auto body = body_above(columns, surface, 40);
                const auto answer = body ? factor_of_safety(*body, SliceMethod::spencer) : std::nullopt;
                return answer && answer->lambda >= 0 ? answer->factor : no_answer;
            },
            no_answer};
}

RatedSurface rated(const SurfaceRating& rating, std::vector<SectionPoint> points) {
    SlipSurface surface{std::move(points), {}};
    const double factor = rating.factor(surface);
    return {factor, std::move(surface)};
}

/// Chen's log spiral for 45 degrees and a friction of 20: F = 1 at gamma H/c = 16.16.
TEST(FreeCorners, ABadPolylineBecomesNearlyTheLogSpiral) {
    SlopeSection section = cut_slope();
    section.strengths[0] = Strength::coulomb(200e3 / 16.16, 20);
    const SlopeColumns columns(section);
    const SurfaceRating rating = by_spencer(columns);
    const RatedSurface start = rated(rating, {{0, 0}, {8, 3}, {18, 10}});
    ASSERT_GT(start.factor, 1.05);
    const RatedSurface end = with_free_corners(columns, start, 8, rating);
    EXPECT_NEAR(end.factor, 1, 0.012);
    EXPECT_GT(end.surface.points.size(), 3);
    EXPECT_LE(end.surface.points.size(), 8);
    EXPECT_DOUBLE_EQ(end.factor, rating.factor(end.surface));
    for (std::size_t k = 1; k + 1 < end.surface.points.size(); ++k) {
        const SectionPoint before = end.surface.points[k] - end.surface.points[k - 1],
                           after = end.surface.points[k + 1] - end.surface.points[k];
        EXPECT_GT(std::atan2(after.y(), after.x()), std::atan2(before.y(), before.x()) - 1e-6) << "it bends upward";
    }
    const RatedSurface again = with_free_corners(columns, start, 8, rating);
    EXPECT_EQ(again.factor, end.factor);
}

TEST(FreeCorners, APartAlongAJointStaysOnIt) {
    SlopeSection section = cut_slope();
    section.joints.push_back({{0, 0}, {18, 2}, 1});
    const SlopeColumns columns(section);
    const SurfaceRating rating = by_spencer(columns);
    const RatedSurface start = rated(rating, {{0, 0}, {9, 1}, {20, 10}});
    const RatedSurface end = with_free_corners(columns, start, 6, rating);
    EXPECT_LT(end.factor, 0.98 * start.factor);
    EXPECT_EQ(end.surface.points[0], start.surface.points[0]) << "where the joint comes to daylight";
    EXPECT_NEAR(end.surface.points[1].y(), end.surface.points[1].x() / 9, 1e-9);
    EXPECT_GT(std::abs(end.surface.points[1].x() - 9), 0.5) << "it moved";
}

TEST(FreeCorners, WhereNothingMayMoveTheSurfaceStays) {
    SlopeSection section = cut_slope();
    section.joints.push_back({{0, 0}, {20, 10}, 1});
    const SlopeColumns columns(section);
    const SurfaceRating rating = by_spencer(columns);
    const RatedSurface start = rated(rating, {{0, 0}, {20, 10}});
    const RatedSurface end = with_free_corners(columns, start, 8, rating);
    EXPECT_EQ(end.surface.points, start.surface.points);
    EXPECT_EQ(end.factor, start.factor);
}

} // namespace
} // namespace kaya
