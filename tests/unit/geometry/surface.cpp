#include "geometry/surface/surface.hpp"

#include "base/diagnostic.hpp"
#include "closed.hpp"
#include "geometry/polyhedra/random.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;
using kaya::test::closed;
using kaya::test::worst_bulge;
using kaya::test::worst_warp;

namespace {

using Loops = std::vector<std::vector<Vec3>>;

/// Unit cube, outward faces: bottom, top, south, north, west, east.
Loops cube() {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    Loops loops;
    for (const auto& face : brick.faces) {
        loops.emplace_back();
        for (const int v : face.vertices) loops.back().push_back(brick.vertices[v]);
    }
    return loops;
}

/// Floor and roof polygons with vertical walls between.
Loops extruded(const std::vector<Vec3>& floor, const Vec3& lift) {
    Loops loops{floor, {}};
    for (const Vec3& v : floor) loops[1].insert(loops[1].begin(), v + lift);
    std::reverse(loops[0].begin(), loops[0].end());
    std::reverse(loops[1].begin(), loops[1].end());
    for (std::size_t i = 0; i < floor.size(); ++i) {
        const Vec3 &a = floor[i], &b = floor[(i + 1) % floor.size()];
        loops.push_back({a, b, b + lift, a + lift});
    }
    return loops;
}

std::string message_of(const Loops& loops) {
    try {
        make_from_faces(loops);
    } catch (const Diagnostic& diagnostic) { return diagnostic.message; }
    return "accepted";
}

double volume_of(const Solid& solid) {
    double volume = 0;
    for (const auto& part : solid.parts) {
        EXPECT_TRUE(closed(part));
        EXPECT_LT(worst_bulge(part), 1e-9);
        volume += mass_properties(part).volume;
    }
    return volume;
}

Loops turned(Loops loops, const Eigen::Quaterniond& rotation, const Vec3& shift) {
    for (auto& loop : loops)
        for (Vec3& v : loop) v = rotation * v + shift;
    return loops;
}

const Eigen::Quaterniond oblique(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));

TEST(Surface, AFineNetOfSinglePrecisionIsOneConvexBlock) {
    constexpr int rings = 40, sides = 80;
    const auto point = [](int i, int j) {
        const double a = i * std::numbers::pi / rings, b = 2 * std::numbers::pi * (j % sides) / sides;
        const double r = i == 0 || i == rings ? 0 : std::sin(a);
        return Vec3(static_cast<float>(r * std::cos(b)), static_cast<float>(r * std::sin(b)),
                    static_cast<float>(std::cos(a)));
    };
    Loops triangles;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            if (i < rings - 1) triangles.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
            if (i > 0) triangles.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
        }
    const Solid solid = solid_from_surface(surface_from_loops(triangles, 1e-9), {1e-3, true});
    ASSERT_EQ(solid.parts.size(), 1u);
    EXPECT_LT(solid.mended_by, 1e-6);
    EXPECT_NEAR(mass_properties(solid.parts[0]).volume, 4 * std::numbers::pi / 3, 0.003 * 4 * std::numbers::pi / 3);
}

} // namespace

TEST(Surface, ACubeFromItsFaces) {
    const Solid solid = make_from_faces(cube(), {0, 0, 0, 0, 0, 9});
    ASSERT_EQ(solid.parts.size(), 1u);
    EXPECT_EQ(solid.parts[0].vertices.size(), 8u);
    EXPECT_EQ(solid.parts[0].faces.size(), 6u);
    EXPECT_EQ(solid.parts[0].faces[5].joint_set, 9);
    EXPECT_EQ(solid.turned_faces, 0);
    EXPECT_EQ(solid.mended_by, 0);
    EXPECT_DOUBLE_EQ(volume_of(solid), 1);
}

TEST(Surface, InsideOutAndMixedFacesAreTurnedOutward) {
    Loops loops = cube();
    for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
    EXPECT_DOUBLE_EQ(volume_of(make_from_faces(loops)), 1);
    loops = cube();
    std::reverse(loops[2].begin(), loops[2].end());
    std::reverse(loops[4].begin(), loops[4].end());
    const Solid solid = make_from_faces(loops);
    EXPECT_EQ(solid.turned_faces, 2);
    EXPECT_DOUBLE_EQ(volume_of(solid), 1);
}

TEST(Surface, NamesTheFaceThatIsWrong) {
    Loops open = cube();
    open.erase(open.begin() + 5);
    EXPECT_EQ(message_of(open), "the surface is open: the edge from (1, 1, 0) to (1, 0, 0) belongs to face 1 alone");
    Loops twice = cube();
    twice.push_back(twice[3]);
    EXPECT_EQ(message_of(twice), "face 7 has the same corners as face 4");
    Loops line = cube();
    line[1] = {{0, 0, 1}, {0.5, 0, 1}, {1, 0, 1}};
    EXPECT_EQ(message_of(line), "face 2 has no area: its corners lie on one line");
    Loops short_face = cube();
    short_face[4] = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    EXPECT_EQ(message_of(short_face), "face 5 has only 2 different corners");
    Loops bow = cube();
    std::swap(bow[1][1], bow[1][2]);
    EXPECT_EQ(message_of(bow).substr(0, 19), "the surface is open");
    Loops infinite = cube();
    infinite[0][0].x() = std::nan("");
    EXPECT_EQ(message_of(infinite), "a corner has a coordinate that is not a finite number");
    EXPECT_EQ(message_of({}), "0 faces do not close a polyhedron");
    Loops third = cube();
    third.push_back({{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0.5}});
    EXPECT_EQ(message_of(third).substr(0, 13), "3 faces meet ");
    Loops two = cube();
    for (auto& loop : turned(cube(), Eigen::Quaterniond::Identity(), Vec3(3, 0, 0))) two.push_back(loop);
    EXPECT_EQ(message_of(two), "the faces fall apart in 2 closed surfaces; face 7 belongs to the second");
    Loops flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
               {{0, 0, 0}, {1, 0, 0}, {0.3, 0.3, 0}},
               {{1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0}},
               {{0, 1, 0}, {0, 0, 0}, {0.3, 0.3, 0}}};
    EXPECT_EQ(message_of(flat), "the surface encloses no volume");
}

TEST(Surface, AnOutlineThatCrossesItselfIsRefused) {
    // A prism over a bow tie.
    EXPECT_EQ(message_of(extruded({{0, 0, 0}, {2, 0, 0}, {0.5, 2, 0}, {2, 2.5, 0}}, {0, 0, 1})),
              "the outline of face 1 crosses itself");
}

TEST(Surface, FacesThatCrossEachOtherAreRefused) {
    // A pyramid whose tip is pushed through its floor from above, with a dent that protrudes outside.
    const Vec3 a(0, 0, 0), b(2, 0, 0), c(2, 2, 0), d(0, 2, 0), top(1, 1, 1), dent(1, 0.8, -1);
    const Loops loops{{a, d, c, b}, {b, c, top},    {c, d, top},   {d, a, top},
                      {a, b, dent}, {b, top, dent}, {top, a, dent}};
    EXPECT_EQ(message_of(loops), "the surface crosses itself: face 1 cuts through face 6");
}

TEST(Surface, SmallWarpIsFlattenedAndLargeIsRefused) {
    Loops loops = turned(cube(), oblique, Vec3(3, -2, 1));
    Random random(2);
    const Surface exact = surface_from_loops(loops, 1e-9);
    std::vector<Vec3> moves;
    for (std::size_t i = 0; i < exact.vertices.size(); ++i)
        moves.push_back(1e-5 * Vec3(random.symmetric(), random.symmetric(), random.symmetric()));
    for (std::size_t f = 0; f < loops.size(); ++f)
        for (std::size_t i = 0; i < loops[f].size(); ++i) loops[f][i] += moves[exact.faces[f].vertices[i]];
    const Solid solid = make_from_faces(loops);
    ASSERT_EQ(solid.parts.size(), 1u);
    EXPECT_EQ(solid.parts[0].faces.size(), 6u);
    EXPECT_LT(worst_warp(solid.parts[0]), 1e-13);
    EXPECT_GT(solid.mended_by, 1e-7);
    EXPECT_LT(solid.mended_by, 3e-5);
    EXPECT_NEAR(volume_of(solid), 1, 1e-4);

    loops = cube();
    for (auto& loop : loops)
        for (Vec3& v : loop)
            if (v == Vec3(1, 1, 1)) v.z() += 0.1;
    EXPECT_EQ(message_of(loops), "face 2 is not flat: its corners lie up to 0.0249 off its mean plane");
    // In either orientation, the diagonal named in the hint gives one convex block.
    for (const double raised : {0.1, -0.1}) {
        loops = cube();
        for (auto& loop : loops)
            for (Vec3& v : loop)
                if (v == Vec3(1, 1, 1)) v.z() += raised;
        try {
            make_from_faces(loops);
            ADD_FAILURE() << "a face that is not flat was taken";
        } catch (const Diagnostic& d) {
            EXPECT_EQ(d.hint, raised > 0
                                  ? "correct the corners, or give two triangles, cut from (0, 0, 1) to (1, 1, 1.1)"
                                  : "correct the corners, or give two triangles, cut from (1, 0, 1) to (0, 1, 1)")
                << raised;
        }
    }
}

// Blocks of a few centimetres whose coordinates have three decimals: faces deviate from their planes by up to 1/100 of the size.
TEST(Surface, FacesOfRoundedCoordinatesBecomeTriangles) {
    Random random(20261123);
    int with_triangles = 0;
    for (int k = 0; k < 200; ++k) {
        const double size = 0.06 + 0.1 * random.uniform();
        Eigen::Vector4d four;
        for (double& part : four) part = random.symmetric();
        const Eigen::Quaterniond turn(four.normalized());
        const Vec3 place(0.3, -0.7, random.symmetric());
        auto loops = cube();
        for (auto& loop : loops)
            for (Vec3& v : loop) {
                v = place + size * (turn * v);
                for (int axis = 0; axis < 3; ++axis) v[axis] = std::round(1000 * v[axis]) / 1000;
            }
        const Solid solid = make_from_faces(loops, {}, {1e-3, false, 1e-2});
        ASSERT_FALSE(solid.parts.empty()) << k;
        EXPECT_NEAR(volume_of(solid), size * size * size, 0.03 * size * size * size) << k;
        with_triangles += solid.triangulated.empty() ? 0 : 1;
    }
    EXPECT_GT(with_triangles, 50);
}

TEST(Surface, TrianglesOfOnePlaneBecomeOneFace) {
    Loops triangles;
    for (const auto& loop : turned(cube(), oblique, Vec3::Zero())) {
        const Vec3 middle = (loop[0] + loop[2]) / 2, side = (loop[0] + loop[1]) / 2;
        triangles.push_back({loop[0], side, middle});
        triangles.push_back({side, loop[1], middle});
        triangles.push_back({loop[1], loop[2], middle});
        triangles.push_back({loop[2], loop[3], middle});
        triangles.push_back({loop[3], loop[0], middle});
    }
    // Corners at midpoints of a neighbour's edges leave the surface open, unlike in a mesh.
    EXPECT_EQ(message_of(triangles).substr(0, 19), "the surface is open");
    triangles.clear();
    for (const auto& loop : turned(cube(), oblique, Vec3::Zero())) {
        const Vec3 middle = (loop[0] + loop[2]) / 2;
        for (int i = 0; i < 4; ++i) {
            const Vec3 side = (loop[i] + loop[(i + 1) % 4]) / 2;
            triangles.push_back({loop[i], side, middle});
            triangles.push_back({side, loop[(i + 1) % 4], middle});
        }
    }
    const Solid solid = make_from_faces(triangles);
    ASSERT_EQ(solid.parts.size(), 1u);
    EXPECT_EQ(solid.parts[0].vertices.size(), 8u);
    EXPECT_EQ(solid.parts[0].faces.size(), 6u);
    EXPECT_NEAR(volume_of(solid), 1, 1e-14);
}

TEST(Surface, ConcaveSolidsBecomeConvexParts) {
    const std::vector<Vec3> angle{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    Solid solid = make_from_faces(extruded(angle, {0, 0, 1}));
    EXPECT_EQ(solid.parts.size(), 2u);
    EXPECT_NEAR(volume_of(solid), 3, 1e-14);
    // The same in an oblique position: rounding must not split it further.
    solid = make_from_faces(turned(extruded(angle, {0, 0, 1}), oblique, Vec3(10, 20, 30)));
    EXPECT_EQ(solid.parts.size(), 2u);
    EXPECT_NEAR(volume_of(solid), 3, 1e-12);

    const std::vector<Vec3> cross{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}, {3, 2, 0}, {2, 2, 0},
                                  {2, 3, 0}, {1, 3, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, 0}};
    solid = make_from_faces(turned(extruded(cross, {0.2, 0.1, 1}), oblique, Vec3(1, 2, 3)));
    EXPECT_LE(solid.parts.size(), 5u);
    EXPECT_NEAR(volume_of(solid), 5, 1e-12);
    // The corners are preserved bit for bit.
    const Loops loops = turned(extruded(cross, {0.2, 0.1, 1}), oblique, Vec3(1, 2, 3));
    std::size_t found = 0;
    for (const Vec3& corner : loops[0])
        for (const auto& part : solid.parts)
            if (std::find(part.vertices.begin(), part.vertices.end(), corner) != part.vertices.end()) {
                ++found;
                break;
            }
    EXPECT_EQ(found, cross.size());
}

TEST(Surface, PartsOfAConcaveSolidKnowTheirJointSet) {
    const std::vector<Vec3> angle{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    const Solid solid = make_from_faces(extruded(angle, {0, 0, 1}), {7, 8});
    double floor = 0;
    for (const auto& part : solid.parts)
        for (const auto& face : part.faces)
            if (face.joint_set == 7) {
                EXPECT_EQ(face_normal(part, face), Vec3(0, 0, -1));
                ++floor;
            }
    EXPECT_EQ(floor, 2);
}

TEST(Surface, StarOfManyPointsKeepsItsVolume) {
    std::vector<Vec3> star;
    for (int i = 0; i < 14; ++i) {
        const double angle = 2 * 3.141592653589793 * i / 14, radius = i % 2 ? 1 : 2.5;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    const double area = 14 * 0.5 * 2.5 * std::sin(2 * 3.141592653589793 / 14);
    const Solid solid = make_from_faces(turned(extruded(star, {0, 0, 2}), oblique, Vec3(5, 5, 5)));
    EXPECT_NEAR(volume_of(solid), 2 * area, 1e-10);
    EXPECT_LE(solid.parts.size(), 20u);
}

TEST(Surface, SeparatesSurfacesThatShareNoEdge) {
    Loops loops = cube();
    for (auto& loop : turned(cube(), Eigen::Quaterniond::Identity(), Vec3(1, 1, 0))) loops.push_back(loop);
    // The two cubes share an edge: four faces meet there, two of each.
    const Surface touching = surface_from_loops(loops, 1e-9);
    EXPECT_EQ(separate(touching).size(), 2u);
    loops = cube();
    for (auto& loop : turned(cube(), Eigen::Quaterniond::Identity(), Vec3(2, 0, 0))) loops.push_back(loop);
    const auto both = separate(surface_from_loops(loops, 1e-9));
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[1].vertices.size(), 8u);
    EXPECT_EQ(both[1].faces[0].name, "face 7");
}
