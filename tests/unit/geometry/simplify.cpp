// Surfaces with fewer triangles: noisy stones, their families, thin shells, limits and wrong surfaces.
#include "geometry/surface/surface_simplify.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/random.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

using namespace kaya;

namespace {

/// A cube of n x n squares on each side, two triangles each; `place` moves the corners, which are between -1 and 1.
Surface cube_of(int n, const std::function<Vec3(const Vec3&)>& place) {
    FaceSoup soup;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int u, int v) {
                        Vec3 p;
                        p[axis] = side;
                        p[(axis + 1) % 3] = 2.0 * u / n - 1;
                        p[(axis + 2) % 3] = 2.0 * v / n - 1;
                        return place(p);
                    };
                    for (std::vector<Vec3> loop : {std::vector<Vec3>{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                   std::vector<Vec3>{at(i, j), at(i + 1, j + 1), at(i, j + 1)}}) {
                        if (side < 0) std::reverse(loop.begin(), loop.end());
                        soup.loops.push_back(std::move(loop));
                    }
                }
    return welded(soup);
}

/// A stone with waves and the noise of a scanner.
Surface stone(int n, int seed) {
    std::vector<Vec3> waves;
    Random random(static_cast<std::uint64_t>(seed));
    for (int k = 0; k < 8; ++k)
        waves.push_back((2 + k) * Vec3(random.symmetric(), random.symmetric(), random.symmetric()));
    return cube_of(n, [&](const Vec3& p) {
        const Vec3 on_sphere = p.normalized();
        double radius = 1;
        for (const Vec3& wave : waves) radius += 0.03 * std::cos(wave.dot(on_sphere) + wave.x());
        // The same for each face that has the corner.
        const double noise = std::sin(1e4 * on_sphere.dot(Vec3(1, 1.7, 2.3)));
        return Vec3((radius + 0.05 / n * noise) * on_sphere.cwiseProduct(Vec3(1, 0.8, 1.2)));
    });
}

double enclosed(const Surface& surface) { return kaya::volume_of(triangles_of(surface)); }

void expect_closed(const Surface& surface) {
    Surface copy = surface;
    EXPECT_NO_THROW(check_faces(copy));
    EXPECT_NO_THROW(EXPECT_EQ(turn_alike(copy), 0));
    EXPECT_FALSE(turn_outward(copy));
    EXPECT_TRUE(crossing_faces(surface).empty());
}

Surface moved(Surface surface, const std::function<Vec3(const Vec3&)>& move) {
    for (Vec3& v : surface.vertices) v = move(v);
    return surface;
}

std::string refusal_of(const Surface& surface, const Simplification& wanted) {
    SimplifyCounts counts;
    try {
        simplified(surface, wanted, counts);
    } catch (const Diagnostic& mistake) { return mistake.message; }
    return "accepted";
}

} // namespace

TEST(Simplify, NoisyStonesKeepTheirShape) {
    for (const int seed : {1, 2}) {
        const Surface given = stone(30, seed); // 10,800 triangles
        SimplifyCounts counts;
        const Surface result = simplified(given, {500, 0}, counts);
        SCOPED_TRACE(seed);
        EXPECT_EQ(counts.bodies, 1u);
        EXPECT_EQ(counts.before, 10800u);
        EXPECT_LE(counts.after, 500u);
        EXPECT_EQ(result.faces.size(), counts.after);
        EXPECT_GT(counts.deviation, 0);
        EXPECT_LT(counts.deviation, 0.01 * size_of(given.vertices));
        EXPECT_NEAR(counts.volume_before, enclosed(given), 1e-9);
        EXPECT_NEAR(counts.volume_after, enclosed(result), 1e-12);
        EXPECT_NEAR(counts.volume_after, counts.volume_before, 1e-3 * counts.volume_before);
        expect_closed(result);
    }
}

TEST(Simplify, MirroredTurnedMovedScaledAndPermutedStonesAreAsGood) {
    const Surface given = stone(20, 7);
    SimplifyCounts first;
    simplified(given, {400, 0}, first);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    Surface permuted = given;
    std::reverse(permuted.faces.begin(), permuted.faces.end());
    Surface inward = given;
    for (auto& face : inward.faces) std::reverse(face.vertices.begin(), face.vertices.end());
    const std::vector<std::tuple<std::string, double, Surface>> others{
        {"mirrored", 1, moved(given, [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); })},
        {"turned", 1, moved(given, [&](const Vec3& v) { return Vec3(turn * v); })},
        {"far away", 1, moved(given, [](const Vec3& v) { return Vec3(v + Vec3(1e5, -2e5, 3e4)); })},
        {"millimetres", 1000, moved(given, [](const Vec3& v) { return Vec3(1000 * v); })},
        {"kilometres", 1e-3, moved(given, [](const Vec3& v) { return Vec3(1e-3 * v); })},
        {"permuted", 1, permuted},
        {"inward", 1, inward},
    };
    for (const auto& [name, scale, surface] : others) {
        SCOPED_TRACE(name);
        SimplifyCounts counts;
        const Surface result = simplified(surface, {400, 0}, counts);
        EXPECT_LE(counts.after, 400u);
        EXPECT_GE(counts.after, 398u);
        // Which of two equal edges goes first depends on the order of faces and on last digits.
        EXPECT_LT(counts.deviation / scale, 1.5 * first.deviation);
        EXPECT_NEAR(counts.volume_after, counts.volume_before, 1e-3 * counts.volume_before);
        expect_closed(result);
    }
}

TEST(Simplify, ADistanceIsKept) {
    const Surface given = stone(16, 3);
    std::size_t before = given.faces.size();
    for (const double limit : {0.005, 0.02, 0.08}) {
        SimplifyCounts counts;
        const Surface result = simplified(given, {0, limit}, counts);
        EXPECT_LE(counts.deviation, limit);
        EXPECT_LT(counts.after, before) << limit;
        before = counts.after;
        expect_closed(result);
    }
    SimplifyCounts both;
    simplified(given, {1000, 0.08}, both);
    EXPECT_NEAR(static_cast<double>(both.after), 1000, 2); // the number is reached first
    SimplifyCounts none;
    EXPECT_EQ(simplified(given, {0, 1e-9}, none).faces.size(), given.faces.size());
    EXPECT_EQ(none.bodies, 0u);
}

TEST(Simplify, FlatSidesLoseNothing) {
    SimplifyCounts counts;
    const Surface cube = simplified(cube_of(12, [](const Vec3& p) { return p; }), {12, 0}, counts);
    EXPECT_EQ(cube.faces.size(), 12u);
    EXPECT_LT(counts.deviation, 1e-9);
    EXPECT_NEAR(enclosed(cube), 8, 1e-9);
    SimplifyCounts again;
    EXPECT_EQ(simplified(cube, {12, 0}, again).faces.size(), 12u); // few enough
    EXPECT_EQ(again.bodies, 0u);
}

// Sides nearer to each other than the triangles are long would cross.
TEST(Simplify, ThinShellsDoNotCrossThemselves) {
    for (const double thickness : {0.2, 0.002}) {
        const Surface dish = cube_of(16, [&](const Vec3& p) {
            return Vec3(p.x(), p.y(), 0.5 * thickness * p.z() + 0.4 * std::cos(3 * p.x()) * std::cos(3 * p.y()));
        });
        SCOPED_TRACE(thickness);
        SimplifyCounts counts;
        const Surface result = simplified(dish, {200, 0}, counts);
        expect_closed(result);
        EXPECT_LT(counts.after, dish.faces.size());
    }
}

TEST(Simplify, WrongSurfacesAreRefused) {
    Surface open = stone(6, 1);
    open.faces.pop_back();
    EXPECT_NE(refusal_of(open, {100, 0}).find("the surface is open"), std::string::npos) << refusal_of(open, {100, 0});
    // Its upper half is pushed through the lower one.
    const Surface crossing = cube_of(10, [](const Vec3& p) {
        const double r = std::max(std::abs(p.x()), std::abs(p.y()));
        return Vec3(p.x(), p.y(), p.z() > 0 ? p.z() - 3 * std::max(0.0, 0.8 - r) : p.z());
    });
    EXPECT_NE(refusal_of(crossing, {200, 0}).find("crosses itself"), std::string::npos)
        << refusal_of(crossing, {200, 0});
    for (const double factor : {0.0, 1e-310, 1e-160, 1e160, 1.5e308}) {
        const Surface strange = moved(stone(6, 1), [&](const Vec3& v) { return Vec3(factor * v); });
        SimplifyCounts counts;
        try {
            EXPECT_LE(simplified(strange, {100, 0}, counts).faces.size(), 100u);
        } catch (const Diagnostic& mistake) { EXPECT_FALSE(mistake.message.empty()); }
    }
}
