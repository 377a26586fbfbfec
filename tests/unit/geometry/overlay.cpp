#include "geometry/overlay/overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace kaya;

namespace {

/// A polygon divided into triangles from its first corner.
PlaneMesh fan(std::vector<Vec2> corners) {
    PlaneMesh mesh;
    for (int k = 1; k + 1 < static_cast<int>(corners.size()); ++k) mesh.triangles.push_back({0, k, k + 1});
    mesh.points = std::move(corners);
    return mesh;
}

Overlay laid_over(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge = 0) {
    Overlay result;
    overlay(side1, side2, tolerance, edge, result);
    return result;
}

struct Moments {
    double area = 0;
    Vec2 first = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

    explicit Moments(const Overlay& overlay) {
        for (const auto& p : overlay.points) {
            area += p.area;
            first += p.area * p.place;
            second += p.area * p.place * p.place.transpose();
        }
    }
};

/// A rectangle whose diagonal does not cross the other polygon.
const PlaneMesh wide = fan({{-9, -9}, {9, -9}, {9, 2}, {-9, 2}});

} // namespace

TEST(Overlay, ASquareHasItsExactSecondMoments) {
    const Overlay laid = laid_over(fan({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), wide, 1e-9);
    EXPECT_NEAR(laid.second_moment(0, 0), 1.0 / 3, 1e-14);
    EXPECT_NEAR(laid.second_moment(1, 1), 1.0 / 3, 1e-14);
    EXPECT_NEAR(laid.second_moment(0, 1), 0.25, 1e-14);
    EXPECT_NEAR(Moments(laid).area, 1, 1e-14);
}

TEST(BalanceAreas, GivesTheCornersOfARectangleAQuarterEach) {
    const PlaneMesh rectangle = fan({{0.5, -1}, {2.5, -1}, {2.5, 0}, {0.5, 0}});
    Overlay laid = laid_over(rectangle, rectangle, 1e-9);
    ASSERT_EQ(laid.points.size(), 4u);
    balance_areas(laid);
    for (const auto& p : laid.points) EXPECT_NEAR(p.area, 0.5, 1e-12);
}

TEST(BalanceAreas, KeepsSumAndCentreAndComesNearerToTheSecondMomentsOfTheOverlap) {
    // Two rectangles, one rotated: an octagonal overlap with intersections of diagonals.
    Overlay laid =
        laid_over(fan({{0, 0}, {2, 0}, {2, 1}, {0, 1}}), fan({{0.3, -0.4}, {1.9, 0.2}, {1.5, 1.4}, {-0.1, 0.8}}), 1e-9);
    const Moments before(laid);
    balance_areas(laid);
    const Moments after(laid);
    EXPECT_NEAR(after.area, before.area, 1e-14);
    EXPECT_LT((after.first - before.first).norm(), 1e-14);
    for (const auto& p : laid.points) EXPECT_GT(p.area, 0);

    EXPECT_LT((after.second - laid.second_moment).norm(), 0.7 * (before.second - laid.second_moment).norm());
}

TEST(BalanceAreas, APointInTheMiddleMakesARectangleExact) {
    const PlaneMesh rectangle = fan({{0.5, -1}, {2.5, -1}, {2.5, 0}, {0.5, 0}});
    for (const auto& [way, count] : {std::pair{FaceTriangles::radial, 5u}, {FaceTriangles::radial_8, 9u}}) {
        Overlay laid = laid_over(radial_mesh(rectangle, way), wide, 1e-9);
        ASSERT_EQ(laid.points.size(), count);
        balance_areas(laid);
        EXPECT_LT((Moments(laid).second - laid.second_moment).norm(), 1e-12);
    }
}

TEST(Overlay, AnEdgeCutsItsTrianglesInSmallerOnes) {
    const Overlay laid = laid_over(fan({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), wide, 1e-9, 0.25);
    EXPECT_EQ(laid.points.size(), 25u);
    EXPECT_NEAR(Moments(laid).area, 1, 1e-14);
    EXPECT_NEAR(laid.second_moment(0, 0), 1.0 / 3, 1e-14);
    for (const auto& p : laid.points) {
        if (p.vertex1 >= 0) continue;
        const auto& t = fan({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        Vec2 place = Vec2::Zero();
        for (int k = 0; k < 3; ++k) place += p.weights1[k] * t.points[t.triangles[p.triangle1][k]];
        EXPECT_LT((place - p.place).norm(), 1e-12);
    }
}

TEST(Overlay, FinePartsDoNotDependOnTheOrderOfSidesAndCorners) {
    const PlaneMesh one = fan({{0, 0}, {2, 0}, {2, 1}, {0, 1}}),
                    other = fan({{0.3, -0.4}, {1.9, 0.2}, {1.5, 1.4}, {-0.1, 0.8}});
    PlaneMesh turned = one; // the same triangles with other first corners
    for (auto& t : turned.triangles) t = {t[1], t[2], t[0]};
    const auto sorted = [](const Overlay& laid) {
        std::vector<std::array<double, 3>> points;
        for (const auto& p : laid.points)
            if (p.area > 0) points.push_back({p.place.x(), p.place.y(), p.area});
        std::ranges::sort(points, [](const auto& a, const auto& b) {
            return std::abs(a[0] - b[0]) > 1e-9 ? a[0] < b[0] : a[1] < b[1];
        });
        return points;
    };
    const auto expected = sorted(laid_over(one, other, 1e-9, 0.3));
    for (const Overlay& laid : {laid_over(other, one, 1e-9, 0.3), laid_over(turned, other, 1e-9, 0.3)}) {
        const auto points = sorted(laid);
        ASSERT_EQ(points.size(), expected.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(points[i][k], expected[i][k], 1e-12);
    }
}

TEST(TriangleAt, FindsThePlaceAndItsWeights) {
    const PlaneMesh square = fan({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    std::array<double, 3> weights;
    EXPECT_EQ(triangle_at(square, {0.75, 0.25}, weights), 0);
    EXPECT_NEAR(weights[0], 0.25, 1e-15);
    EXPECT_NEAR(weights[1], 0.5, 1e-15);
    EXPECT_EQ(triangle_at(square, {0.25, 0.75}, weights), 1);
    EXPECT_EQ(triangle_at(square, {-0.1, 0.5}, weights), 1); // outside: the nearest
}

TEST(BalanceAreas, LeavesATriangleAlone) {
    const PlaneMesh triangle = fan({{0, 0}, {2, 0.1}, {0.4, 1}});
    Overlay laid = laid_over(triangle, triangle, 1e-9);
    const double first = laid.points[0].area;
    balance_areas(laid);
    EXPECT_EQ(laid.points[0].area, first);
}
