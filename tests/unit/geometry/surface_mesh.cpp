// Surfaces of triangles with shared corners: joining, cutting, refining.
#include "geometry/surface/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

using namespace kaya;

namespace {

using Corners = std::array<Vec3, 3>;

std::array<Vec3, 3> corners_of(const SurfaceMesh& mesh, std::size_t t) {
    const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(mesh.triangles[t][k])]; };
    return {at(0), at(1), at(2)};
}

Vec3 area_vector(const Corners& c) { return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]); }

Vec3 area_vector(const SurfaceMesh& mesh) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += area_vector(corners_of(mesh, t));
    return sum;
}

double longest_side(const SurfaceMesh& mesh) {
    double most = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto c = corners_of(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) most = std::max(most, (c[(k + 1) % 3] - c[k]).norm());
    }
    return most;
}

double least_angle(const SurfaceMesh& mesh) {
    double least = 180;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto c = corners_of(mesh, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = c[(k + 1) % 3] - c[k], b = c[(k + 2) % 3] - c[k];
            least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::acos(-1.0));
        }
    }
    return least;
}

/// The number of triangles at each side, independent of its direction.
std::map<std::pair<int, int>, int> sides_of(const SurfaceMesh& mesh) {
    std::map<std::pair<int, int>, int> sides;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
    return sides;
}

/// Length of the sides of only one triangle.
double border(const SurfaceMesh& mesh) {
    double length = 0;
    for (const auto& [side, count] : sides_of(mesh)) {
        EXPECT_LE(count, 2);
        if (count == 1)
            length +=
                (mesh.points[static_cast<std::size_t>(side.first)] - mesh.points[static_cast<std::size_t>(side.second)])
                    .norm();
    }
    return length;
}

/// A rectangle as two triangles.
void add_rectangle(std::vector<Corners>& triangles, double x0, double x1, double y0, double y1) {
    triangles.push_back({Vec3(x0, y0, 0), Vec3(x1, y0, 0), Vec3(x1, y1, 0)});
    triangles.push_back({Vec3(x0, y0, 0), Vec3(x1, y1, 0), Vec3(x0, y1, 0)});
}

/// A wall of bricks in running bond: corners of one course are on sides of the next.
std::vector<Corners> wall() {
    std::vector<Corners> triangles;
    for (int course = 0; course < 4; ++course)
        for (int brick = 0; brick <= 3; ++brick) {
            const double shift = course % 2 == 0 ? 0 : 0.5;
            const double x0 = std::max(0.0, brick - shift), x1 = std::min(3.0, brick + 1 - shift);
            if (x1 > x0) add_rectangle(triangles, x0, x1, course, course + 1);
        }
    return triangles;
}

std::vector<Corners> turned(std::vector<Corners> triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    const Vec3 shift(100 * any(random), 100 * any(random), 100 * any(random));
    for (auto& corners : triangles)
        for (Vec3& corner : corners)
            corner = shift + turn * corner + 1e-7 * Vec3(any(random), any(random), any(random));
    std::shuffle(triangles.begin(), triangles.end(), random);
    return triangles;
}

} // namespace

TEST(SurfaceMesh, RefinesAFaceThatIsThereTwiceAsOne) {
    // Of two blocks in one place.
    const std::array<Vec3, 3> face{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 0.5, 0)};
    for (const double edge : {3.0, 1.0, 0.1}) {
        SurfaceMesh mesh = joined_surface({face, {face[1], face[2], face[0]}}, 1e-5);
        refine(mesh, edge);
        double area = 0;
        for (const auto& t : mesh.triangles) {
            const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
            area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
            for (std::size_t k = 0; k < 3; ++k) EXPECT_LE((at(k) - at((k + 1) % 3)).norm(), edge);
        }
        EXPECT_NEAR(area, 1, 1e-12);
    }
}

TEST(SurfaceMesh, JoinsCornersThatAreNearlyTheSame) {
    const SurfaceMesh mesh = joined_surface(turned(wall(), 1), 1e-5);
    EXPECT_EQ(mesh.triangles.size(), wall().size());
    EXPECT_EQ(mesh.points.size(), 4U + 3 * 7U + 5U);
}

TEST(SurfaceMesh, LeavesOutTrianglesThatAreNarrowerThanItSees) {
    std::vector<Corners> triangles;
    add_rectangle(triangles, 0, 1, 0, 1);
    add_rectangle(triangles, 1, 1.000001, 0, 1);
    triangles.push_back({Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(1, 0, 0)});
    triangles.push_back({Vec3(3, 3, 3), Vec3(3, 3, 3), Vec3(3, 3, 3)});
    EXPECT_EQ(joined_surface(triangles, 1e-4).triangles.size(), 2U);
    EXPECT_TRUE(joined_surface({}, 1e-4).triangles.empty());
}

TEST(SurfaceMesh, CutsAtCornersOfNeighboursHoweverItLies) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto triangles = turned(wall(), seed);
        SurfaceMesh mesh = joined_surface(triangles, 1e-5);
        const Vec3 before = area_vector(mesh);
        EXPECT_GT(border(mesh), 14.1); // the sides between courses are not shared yet
        cut_at_corners(mesh, 1e-5);
        EXPECT_NEAR(border(mesh), 14, 1e-4) << seed;
        EXPECT_LT((area_vector(mesh) - before).norm(), 1e-5);
        EXPECT_NEAR(before.norm(), 12, 1e-4);
    }
}

TEST(SurfaceMesh, RefinesToSidesOfTheWantedLengthAndKeepsItsAngles) {
    for (const double edge : {2.0, 0.7, 0.3, 0.1}) {
        SurfaceMesh mesh = joined_surface(turned(wall(), 7), 1e-5);
        cut_at_corners(mesh, 1e-5);
        const double before = least_angle(mesh);
        refine(mesh, edge);
        EXPECT_LE(longest_side(mesh), edge * (1 + 1e-12));
        EXPECT_NEAR(border(mesh), 14, 1e-4);
        EXPECT_NEAR(area_vector(mesh).norm(), 12, 1e-4);
        EXPECT_GE(least_angle(mesh), 0.5 * before); // Rosenberg and Stenger 1975
    }
}

TEST(SurfaceMesh, MakesGoodTrianglesOfLongFaces) {
    for (const double width : {0.02, 0.1, 0.3, 1.0})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            std::vector<Corners> long_face;
            add_rectangle(long_face, 0, 5, 0, width);
            SurfaceMesh mesh = joined_surface(turned(long_face, seed), 1e-5);
            const double edge = 1.5 * width;
            refine(mesh, edge);
            EXPECT_LE(longest_side(mesh), edge * (1 + 1e-12));
            EXPECT_NEAR(area_vector(mesh).norm(), 5 * width, 1e-5);
            EXPECT_NEAR(border(mesh), 2 * (5 + width), 1e-4);
            EXPECT_GT(least_angle(mesh), 15) << width;
        }
}

TEST(SurfaceMesh, KeepsTheShapeOfCurvedSurfaces) {
    // Two sides of a roof: the ridge is kept, although its diagonal would be the better side.
    std::vector<Corners> roof;
    roof.push_back({Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(2, -0.3, 0)});
    roof.push_back({Vec3(4, 0, 1), Vec3(0, 0, 1), Vec3(2, 0.3, 0)});
    SurfaceMesh mesh = joined_surface(roof, 1e-5);
    refine(mesh, 0.25);
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += area_vector(corners_of(mesh, t)).norm();
    EXPECT_NEAR(area, 4 * std::hypot(1, 0.3), 1e-9);
}

TEST(SurfaceMesh, KeepsOnlyPointsThatATriangleHas) {
    SurfaceMesh mesh = joined_surface(wall(), 1e-5);
    std::vector<char> kept(mesh.triangles.size(), 0);
    kept[3] = 1;
    const auto corners = corners_of(mesh, 3);
    keep_triangles(mesh, kept);
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.points.size(), 3U);
    EXPECT_EQ(corners_of(mesh, 0), corners);
}
