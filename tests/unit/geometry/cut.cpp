#include "geometry/polyhedra/cut.hpp"

#include "closed.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <set>
#include <tuple>

using namespace kaya;
using kaya::test::closed;
using kaya::test::worst_bulge;
using kaya::test::worst_warp;

namespace {

Vec3 random_unit(Random& random) {
    for (;;) {
        const Vec3 v(random.symmetric(), random.symmetric(), random.symmetric());
        if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
    }
}

std::vector<Vec3> corners(const Polyhedron& p, const Polyhedron::Face& face) {
    std::vector<Vec3> result;
    for (const int v : face.vertices) result.push_back(p.vertices[v]);
    return result;
}

/// Cuts every piece by the plane; pieces that it misses are unchanged.
void cut_all(std::vector<Polyhedron>& pieces, const Plane& plane, int joint_set = 1) {
    const std::size_t count = pieces.size();
    for (std::size_t i = 0; i < count; ++i) {
        Cut parts = cut(pieces[i], plane, joint_set);
        if (parts.outcome != CutOutcome::cut) continue;
        pieces[i] = std::move(parts.below);
        pieces.push_back(std::move(parts.above));
    }
}

/// Compares volume and first moment of all pieces with those of the whole.
void expect_conserved(const std::vector<Polyhedron>& pieces, const MassProperties& whole, double size) {
    double volume = 0;
    Vec3 moment = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const Polyhedron& piece : pieces) {
        const MassProperties m = mass_properties(piece);
        const Vec3 arm = m.centroid - whole.centroid;
        volume += m.volume;
        moment += m.volume * arm;
        second += m.inertia + m.volume * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    }
    EXPECT_NEAR(volume, whole.volume, 1e-12 * whole.volume);
    EXPECT_LT(moment.norm(), 1e-12 * whole.volume * size);
    EXPECT_LT((second - whole.inertia).norm(), 1e-12 * whole.volume * size * size);
}

} // namespace

TEST(Cut, HalvesABrickAndSharesTheFaceBitForBit) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 2, 3});
    const Cut parts = cut(brick, {normal_from_dip(30, 75), {0.4, 1.1, 1.3}}, 7);
    ASSERT_EQ(parts.outcome, CutOutcome::cut);
    EXPECT_TRUE(closed(parts.above));
    EXPECT_TRUE(closed(parts.below));
    const auto& top = parts.below.faces.back();
    const auto& bottom = parts.above.faces.back();
    EXPECT_EQ(top.joint_set, 7);
    EXPECT_EQ(bottom.joint_set, 7);
    auto from_above = corners(parts.above, bottom);
    const auto from_below = corners(parts.below, top);
    std::reverse(from_above.begin() + 1, from_above.end());
    EXPECT_EQ(from_above, from_below);
    EXPECT_GT(face_normal(parts.below, top).dot(normal_from_dip(30, 75)), 1 - 1e-14);
    expect_conserved({parts.above, parts.below}, mass_properties(brick), 3);
}

TEST(Cut, ReportsTheSideOfAPolyhedronThatThePlaneMissesOrTouches) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(cut(brick, {Vec3::UnitZ(), {0, 0, -1}}, 1).outcome, CutOutcome::above);
    EXPECT_EQ(cut(brick, {Vec3::UnitZ(), {0, 0, 2}}, 1).outcome, CutOutcome::below);
    EXPECT_EQ(cut(brick, {Vec3::UnitZ(), {0, 0, 0}}, 1).outcome, CutOutcome::above);
    EXPECT_EQ(cut(brick, {Vec3::UnitZ(), {0, 0, 1}}, 1).outcome, CutOutcome::below);
    // along an edge, through a corner
    EXPECT_EQ(cut(brick, {normal_from_dip(45, 90), {1, 0, 1}}, 1).outcome, CutOutcome::below);
    EXPECT_EQ(cut(brick, {Vec3(1, 1, 1).normalized(), {1, 1, 1}}, 1).outcome, CutOutcome::below);
}

TEST(Cut, ThroughCornersMakesNoNewVertices) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    const Cut diagonal = cut(brick, {normal_from_dip(45, 90), {1, 0, 0}}, 1);
    ASSERT_EQ(diagonal.outcome, CutOutcome::cut);
    EXPECT_EQ(diagonal.above.vertices.size(), 6u);
    EXPECT_EQ(diagonal.below.vertices.size(), 6u);
    EXPECT_NEAR(mass_properties(diagonal.above).volume, 0.5, 1e-15);
    const Cut corner = cut(brick, {Vec3(1, 1, 1).normalized(), {1, 0, 0}}, 1);
    ASSERT_EQ(corner.outcome, CutOutcome::cut);
    EXPECT_EQ(corner.below.vertices.size(), 4u);
    EXPECT_EQ(corner.above.vertices.size(), 7u);
    EXPECT_NEAR(mass_properties(corner.below).volume, 1.0 / 6, 1e-15);
}

TEST(Cut, RefusesAPieceThinnerThanAllowedAndLeavesTheBlockWhole) {
    const Polyhedron brick = make_brick({0, 0, 0}, {1, 1, 1});
    const Cut plate = cut(brick, {Vec3::UnitZ(), {0, 0, 0.999}}, 1, 0.01);
    EXPECT_EQ(plate.outcome, CutOutcome::sliver);
    EXPECT_TRUE(plate.above.faces.empty());
    EXPECT_EQ(cut(brick, {Vec3::UnitZ(), {0, 0, 0.98}}, 1, 0.01).outcome, CutOutcome::cut);
    // A wedge is thick below its plane, but the tip cut off by a second plane is a needle.
    const Cut wedge = cut(brick, {normal_from_dip(10, 90), {0, 0, 0.2}}, 1, 0.01);
    ASSERT_EQ(wedge.outcome, CutOutcome::cut);
    EXPECT_EQ(cut(wedge.above, {Vec3::UnitZ(), {0, 0, 0.05}}, 1, 0.01).outcome, CutOutcome::cut);
    EXPECT_EQ(cut(wedge.below, {Vec3::UnitX(), {1.105, 0, 0}}, 1, 0.01).outcome, CutOutcome::below);
    EXPECT_EQ(cut(wedge.below, {Vec3::UnitX(), {0.97, 0, 0}}, 1, 0.01).outcome, CutOutcome::cut);
    EXPECT_EQ(cut(wedge.below, {Vec3::UnitX(), {0.97, 0, 0}}, 1, 0.031).outcome, CutOutcome::sliver);
}

TEST(Cut, ANeedleDeepBelowThePlaneIsASliver) {
    // The tip of a thin wedge, 0.1 long but 0.001 thick.
    Polyhedron wedge = cut(make_brick({0, 0, 0}, {1, 1, 1}), {Vec3(-0.01, 0, 1).normalized(), {0, 0, 0}}, 1).below;
    ASSERT_NEAR(thickness(wedge), 0.01, 1e-6);
    EXPECT_EQ(cut(wedge, {Vec3::UnitX(), {0.1, 0, 0}}, 1, 0.002).outcome, CutOutcome::sliver);
    EXPECT_EQ(cut(wedge, {Vec3::UnitX(), {0.1, 0, 0}}, 1, 0.0005).outcome, CutOutcome::cut);
}

TEST(Cut, NeighboursKeepSharingTheirEdges) {
    // Two adjacent bricks with different corner order, cut by the same oblique planes: the corners on the common side must be the same
    // numbers.
    Random random(5);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Polyhedron> left{make_brick({0, 0, 0}, {1, 1.1, 1.2})};
        std::vector<Polyhedron> right{make_brick({2.3, 1.1, 1.2}, {1, 0, 0})};
        for (int i = 0; i < 3; ++i) {
            const Plane plane{random_unit(random), Vec3(1, 0.5 + 0.2 * random.symmetric(), 0.6)};
            cut_all(left, plane);
            cut_all(right, plane);
        }
        using Point = std::tuple<double, double, double>;
        const auto on_border = [](const std::vector<Polyhedron>& pieces) {
            std::set<Point> points;
            for (const auto& piece : pieces)
                for (const Vec3& v : piece.vertices)
                    if (v.x() == 1) points.insert({v.x(), v.y(), v.z()});
            return points;
        };
        EXPECT_EQ(on_border(left), on_border(right)) << trial;
    }
}

TEST(Cut, KeepsVolumeAndMomentsThroughRandomCuts) {
    Random random(11);
    for (int trial = 0; trial < 20; ++trial) {
        const Polyhedron brick = make_brick({-1, 0, 2}, {1, 1, 4});
        std::vector<Polyhedron> pieces{brick};
        for (int i = 0; i < 12; ++i)
            cut_all(pieces, {random_unit(random), Vec3(0.8 * random.symmetric(), 0.5, 3 + 0.8 * random.symmetric())});
        EXPECT_GT(pieces.size(), 50u);
        for (const auto& piece : pieces) {
            ASSERT_TRUE(closed(piece));
            ASSERT_LT(worst_bulge(piece), 1e-12);
        }
        expect_conserved(pieces, mass_properties(brick), 2);
    }
}

TEST(Cut, PlanesThroughOneLineAndOnePointLeaveNoSplinters) {
    // The hardest case for rounded vertices: all planes intersect in one point, some in one line.
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
        const Vec3 hub(0.3 * random.symmetric(), 0.3 * random.symmetric(), 0.3 * random.symmetric());
        const Vec3 axis = random_unit(random);
        const Polyhedron brick = make_brick({-1, -1, -1}, {1, 1, 1});
        std::vector<Polyhedron> pieces{brick};
        for (int i = 0; i < 6; ++i) {
            cut_all(pieces, {random_unit(random).cross(axis).normalized(), hub});
            cut_all(pieces, {random_unit(random), hub});
        }
        double smallest = 1;
        for (const auto& piece : pieces) {
            ASSERT_TRUE(closed(piece));
            ASSERT_LT(worst_bulge(piece), 1e-11);
            smallest = std::min(smallest, mass_properties(piece).volume);
        }
        EXPECT_GT(smallest, 1e-12) << trial;
        expect_conserved(pieces, mass_properties(brick), 2);
    }
}

TEST(Cut, RepeatingAPlaneChangesNothing) {
    Random random(8);
    for (int trial = 0; trial < 100; ++trial) {
        std::vector<Polyhedron> pieces{make_brick({0, 0, 0}, {1, 1, 1})};
        std::vector<Plane> planes;
        for (int i = 0; i < 6; ++i) planes.push_back({random_unit(random), Vec3(0.5, 0.5, 0.3 + 0.1 * i)});
        for (const auto& plane : planes) cut_all(pieces, plane);
        const std::size_t count = pieces.size();
        for (const auto& plane : planes) cut_all(pieces, plane);
        EXPECT_EQ(pieces.size(), count) << trial;
    }
}

TEST(Cut, WorksFarFromTheOrigin) {
    Random random(4);
    const Vec3 far(5e5, 4e6, 1e3);
    const Polyhedron brick = make_brick(far, far + Vec3(100, 100, 100));
    std::vector<Polyhedron> pieces{brick};
    for (int i = 0; i < 10; ++i)
        cut_all(pieces, {random_unit(random), far + Vec3(50 + 20 * random.symmetric(), 50, 50)});
    double volume = 0;
    for (const auto& piece : pieces) {
        ASSERT_TRUE(closed(piece));
        ASSERT_LT(worst_warp(piece), 1e-6);
        volume += mass_properties(piece).volume;
    }
    EXPECT_NEAR(volume, 1e6, 1e6 * 1e-10); // coordinates of 4e6 leave ten digits of a length of 100
}
