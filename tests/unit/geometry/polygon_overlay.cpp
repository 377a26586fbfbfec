#include "geometry/overlay/polygon_overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace kaya;

namespace {

using Polygon = std::vector<Vec2>;

/// Integrals over a polygon by triangles from its first corner, each cut in many.
struct Integrals {
    double area = 0, distance = 0;
    Vec2 centre = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero(); ///< about the centre

    explicit Integrals(const Overlay& points, const Vec2& about) : centre(Vec2::Zero()) {
        for (const auto& p : points.points) {
            const Vec2 arm = p.place - about;
            area += p.area;
            centre += p.area * p.place;
            second += p.area * arm * arm.transpose();
            distance += p.area * arm.norm();
        }
        centre /= area;
    }
};

/// The same places, many of them: the middles of small triangles.
Overlay fine(const Polygon& polygon, int parts) {
    Overlay points;
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 u = (polygon[i] - polygon[0]) / parts, v = (polygon[i + 1] - polygon[0]) / parts;
        const double area = 0.5 * cross(u, v);
        for (int a = 0; a < parts; ++a)
            for (int b = 0; a + b < parts; ++b) {
                const auto add = [&](double third) {
                    OverlayPoint& p = points.points.emplace_back();
                    p.place = polygon[0] + (a + third) * u + (b + third) * v;
                    p.area = area;
                };
                add(1.0 / 3);
                if (a + b + 1 < parts) add(2.0 / 3);
            }
    }
    return points;
}

Overlay points_of(const Polygon& polygon) {
    Overlay found;
    OverlayScratch scratch;
    points_of_polygon(polygon, 0, 1e-9, found, scratch);
    return found;
}

/// Area and centre by the corners: sums over many small triangles round too much for them.
std::pair<double, Vec2> area_and_centre(const Polygon& polygon) {
    double area = 0;
    Vec2 centre = Vec2::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Vec2 u = polygon[i] - polygon[0], v = polygon[i + 1] - polygon[0];
        const double part = 0.5 * (u.x() * v.y() - u.y() * v.x());
        area += part;
        centre += part * (u + v) / 3;
    }
    return {area, polygon[0] + centre / area};
}

/// Integrals (3) of docs/theory/contacts.md; `twist`: how far friction against twisting may be off.
void expect_exact(const Polygon& polygon, double twist) {
    const Overlay found = points_of(polygon);
    ASSERT_EQ(found.points.size(), polygon.size() + 4);
    for (const auto& p : found.points) EXPECT_GT(p.area, 0);
    for (std::size_t i = 0; i < polygon.size(); ++i) EXPECT_EQ(found.points[i].place, polygon[i]);
    const auto [area, centre] = area_and_centre(polygon);
    const Integrals ours(found, centre), exact(fine(polygon, 160), centre);
    EXPECT_NEAR(ours.area, area, 1e-12 * area);
    EXPECT_NEAR((ours.centre - centre).norm(), 0, 1e-12);
    EXPECT_NEAR((ours.second - exact.second).norm(), 0, 1e-4 * exact.second.norm());
    EXPECT_NEAR(ours.distance, exact.distance, twist * exact.distance);
}

Polygon regular(int corners) {
    Polygon polygon;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners + 0.3;
        polygon.emplace_back(std::cos(angle), std::sin(angle));
    }
    return polygon;
}

} // namespace

TEST(PointsOfPolygon, ASquareResistsTwistingAsItsAreaDoes) {
    // The mean distance from the centre of a square of side 1 is (sqrt 2 + asinh 1)/6.
    const Overlay found = points_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    const Integrals ours(found, {0.5, 0.5});
    EXPECT_NEAR(ours.distance, (std::sqrt(2.0) + std::asinh(1.0)) / 6, 1e-14);
    EXPECT_NEAR(ours.second(0, 0), 1.0 / 12, 1e-14);
    EXPECT_NEAR(ours.second(1, 1), 1.0 / 12, 1e-14);
    EXPECT_NEAR(ours.second(0, 1), 0, 1e-14);
}

TEST(PointsOfPolygon, AStripAndATriangleDoToo) {
    expect_exact({{0, 0}, {30, 0}, {30, 1}, {0, 1}}, 1e-4);
    expect_exact({{0, 0}, {1, 0}, {0, 1}}, 1e-4);
    expect_exact({{0, 0}, {10, 0}, {0, 1}}, 1e-4);
    expect_exact({{1, 0}, {0, 0.1}, {-1, 0}, {0, -0.1}}, 1e-4);
}

TEST(PointsOfPolygon, RegularPolygonsDoToo) {
    for (const int corners : {3, 4, 5, 6, 8, 12}) expect_exact(regular(corners), 1e-4);
}

TEST(PointsOfPolygon, AnyConvexPolygonDoesToo) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1);
    for (int i = 0; i < 60; ++i) {
        const int corners = 3 + i % 6;
        std::vector<double> angles;
        for (int k = 0; k < corners; ++k) angles.push_back(2 * std::numbers::pi * (k + 0.8 * any(random)) / corners);
        const double flat = 0.2 + 0.8 * any(random), skew = any(random) - 0.5;
        Polygon polygon;
        for (const double a : angles) polygon.emplace_back(std::cos(a) + skew * std::sin(a), flat * std::sin(a));
        expect_exact(polygon, 1e-3);
    }
}

TEST(PointsOfPolygon, PlacesDoNotDependOnWhereThePolygonIs) {
    const Polygon here{{0, 0}, {2, 0.1}, {1.7, 1}, {0.2, 0.8}};
    Polygon there = here;
    const Vec2 shift(12, -3);
    std::rotate(there.begin(), there.begin() + 1, there.end());
    for (Vec2& p : there) p += shift;
    const Overlay a = points_of(here), b = points_of(there);
    for (const auto& p : a.points) {
        const auto same = [&](const OverlayPoint& q) {
            return (q.place - shift - p.place).norm() < 1e-9 && std::abs(q.area - p.area) < 1e-9;
        };
        EXPECT_TRUE(std::ranges::any_of(b.points, same));
    }
}
