// The surface around convex parts.
#include "geometry/surface/outer_surface.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

using BodyChange = std::function<Vec3(const Vec3&)>;

double volume_inside(const Surface& surface) {
    double volume = 0;
    for (const Polyhedron& part : solid_from_surface(surface, {1e-3, true}).parts)
        volume += mass_properties(part).volume;
    return volume;
}

double whole_volume(const std::vector<Polyhedron>& parts) {
    double volume = 0;
    for (const Polyhedron& part : parts) volume += mass_properties(part).volume;
    return volume;
}

double area_around(const Surface& surface) {
    double area = 0;
    for (const auto& face : surface.faces) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 2; k < face.vertices.size(); ++k) {
            const auto corner = [&](std::size_t i) {
                return surface.vertices[static_cast<std::size_t>(face.vertices[i])];
            };
            sum += 0.5 * (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
        }
        area += sum.norm();
    }
    return area;
}

/// An L of three bricks, a bench with two steps, and bricks in a running bond: faces that cover each other in part.
std::vector<std::vector<Polyhedron>> three_bodies() {
    std::vector<std::vector<Polyhedron>> all;
    all.push_back(
        {make_brick({0, 0, 0}, {3, 1, 1}), make_brick({0, 0, 1}, {1, 1, 2}), make_brick({0, 0, 2}, {1, 1, 5})});
    all.push_back(
        {make_brick({0, 0, 0}, {4, 4, 1}), make_brick({1, 1, 1}, {3, 3, 2}), make_brick({1.5, 1.5, 2}, {2, 2, 3})});
    std::vector<Polyhedron> wall;
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k) {
            const double x = 2 * k + (row % 2);
            wall.push_back(make_brick({x, 0, 1. * row}, {x + 2, 1, row + 1.}));
        }
    all.push_back(wall);
    return all;
}

void turn_over(std::vector<Polyhedron>& parts) {
    for (Polyhedron& part : parts)
        for (auto& face : part.faces) std::ranges::reverse(face.vertices);
}

} // namespace

TEST(OuterSurface, AreaAndVolumeAreThoseOfTheBody) {
    const std::array<double, 3> areas{14 - 1 + 16 + 1, 2 * 16 + 4 * 4 + 4 * 2 + 4 * 0.5,
                                      2 * 18 + 2 * 3 + 6 + 6 + 2 + 2};
    const auto all = three_bodies();
    for (std::size_t b = 0; b < all.size(); ++b) {
        const auto surface = outer_surface(all[b]);
        ASSERT_TRUE(surface.has_value()) << b;
        EXPECT_NEAR(volume_inside(*surface), whole_volume(all[b]), 1e-12 * whole_volume(all[b])) << b;
        EXPECT_NEAR(area_around(*surface), areas[b], 1e-12 * areas[b]) << b;
    }
}

/// Pieces of random cuts, without some of them, in any order: the volume stays in every frame.
TEST(OuterSurface, PiecesOfRandomCutsInEveryFrame) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
    struct Row {
        BodyChange frame;
        bool mirrored;
    };
    const std::array rows{Row{[](const Vec3& v) { return v; }, false},
                          Row{[&](const Vec3& v) { return Vec3(turn * v); }, false},
                          Row{[](const Vec3& v) { return Vec3(v.x(), -v.y(), v.z()); }, true},
                          Row{[](const Vec3& v) { return Vec3(0.001 * v); }, false},
                          Row{[](const Vec3& v) { return Vec3(v + Vec3(2e5, 1e5, -3e4)); }, false}};
    int closed = 0, tried = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        for (const Row& row : rows) {
            Random random(seed);
            std::vector<Polyhedron> parts{make_brick({0, 0, 0}, {4, 3, 2})};
            for (int k = 0; k < 3; ++k) {
                const Plane plane{normal_from_dip(90 * random.uniform(), 360 * random.uniform()),
                                  {1 + 2 * random.uniform(), 1 + random.uniform(), 0.5 + random.uniform()}};
                std::vector<Polyhedron> next;
                for (const Polyhedron& one : parts) {
                    const Cut both = cut(one, plane, 1);
                    for (const Polyhedron* part : {&both.below, &both.above})
                        if (!part->faces.empty()) next.push_back(*part);
                }
                parts = std::move(next);
            }
            parts.pop_back(); // a concave body is left
            for (Polyhedron& part : parts)
                for (Vec3& v : part.vertices) v = row.frame(v);
            if (row.mirrored) turn_over(parts);
            const double volume = whole_volume(parts);
            for (int order = 0; order < 2; ++order) {
                ++tried;
                const auto surface = outer_surface(parts);
                if (surface) {
                    ++closed;
                    EXPECT_NEAR(volume_inside(*surface), volume, 1e-9 * volume) << seed;
                }
                std::ranges::reverse(parts);
            }
        }
    EXPECT_EQ(closed, tried);
}

TEST(OuterSurface, PartsThatAreApartStayOpenOrSeparate) {
    const Polyhedron one = make_brick({0, 0, 0}, {1, 1, 1});
    const auto both = outer_surface({one, make_brick({3, 0, 0}, {4, 1, 1})});
    ASSERT_TRUE(both.has_value());
    EXPECT_EQ(separate(*both).size(), 2U);
    EXPECT_EQ(both->faces.size(), 12U);
}
