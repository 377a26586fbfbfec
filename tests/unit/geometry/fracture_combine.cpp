// Fractures that are put into one plane.
#include "geometry/fractures/combine.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/polyhedra/random.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;

namespace {

using Joining = Combining::Joining;
using Network = std::vector<Fracture>;

Combined combined(Network& network, const Combining& how) {
    std::vector<Fracture*> pointers;
    for (Fracture& fracture : network) pointers.push_back(&fracture);
    return combine(pointers, how);
}

void number(Network& network) {
    for (std::size_t i = 0; i < network.size(); ++i) network[i].id = static_cast<std::int64_t>(i) + 1;
}

double angle_between(const Fracture& a, const Fracture& b) {
    const Vec3 n = plane_of(a).normal, m = plane_of(b).normal;
    return std::atan2(n.cross(m).norm(), std::abs(n.dot(m))) * 180 / std::numbers::pi;
}

/// Discs and squares in a box of 20.
Network random_network(std::uint64_t seed, int count) {
    Random random(seed);
    Network network;
    for (int k = 0; k < count; ++k) {
        Fracture fracture{{20 * Vec3(random.uniform(), random.uniform(), random.uniform()), 60 + 30 * random.uniform(),
                           90 + 180 * (k % 2) + 20 * random.symmetric(), 1 + 9 * random.uniform()}};
        if (k % 3 == 0) fracture = polygon_fracture(outline_of(fracture, 4));
        network.push_back(fracture);
    }
    number(network);
    return network;
}

double area_vector_up(const std::vector<Vec3>& corners) { return area_vector(corners).z(); }

double whole_area(const Network& network) {
    double area = 0;
    for (const Fracture& fracture : network) area += area_of(fracture);
    return area;
}

} // namespace

TEST(FractureCombine, SmallerOnesGetTheDirectionOfLargerOnes) {
    Network network{
        {{{0, 0, 0}, 30, 90, 10}}, {{{1, 2, 0}, 34, 90, 4}}, {{{1, 2, 3}, 30, 90, 4}}, {{{1, 2, 0}, 50, 90, 4}}};
    number(network);
    const Network before = network;
    const double height = plane_of(network[0]).distance(network[1].disc.centre);
    ASSERT_LT(std::abs(height), 1);
    const Combined done = combined(network, {5, 1, Joining::turn});
    EXPECT_EQ(done.turned, 1u);
    EXPECT_EQ(done.moved, 0u);
    EXPECT_EQ(network[0], before[0]);
    EXPECT_EQ(network[1].disc, (Disc{{1, 2, 0}, 30, 90, 4}));
    EXPECT_EQ(network[2], before[2]); // too far
    EXPECT_EQ(network[3], before[3]); // too steep
    network = before;
    EXPECT_EQ(combined(network, {5, 1, Joining::collapse}).moved, 1u);
    EXPECT_NEAR(plane_of(network[0]).distance(network[1].disc.centre), 0, 1e-15);
    EXPECT_LT((network[1].disc.centre - before[1].disc.centre + height * plane_of(before[0]).normal).norm(), 1e-15);
}

/// Two steep planes on both sides of the vertical are near each other, whichever way they dip.
TEST(FractureCombine, SteepPlanesDipToBothSides) {
    for (const bool polygons : {false, true}) {
        Network network{{{{0, 0, 0}, 88, 90, 10}}, {{{0, 1, 1}, 89, 270, 4}}};
        if (polygons)
            for (Fracture& fracture : network) fracture = polygon_fracture(outline_of(fracture, 8));
        number(network);
        EXPECT_EQ(combined(network, {2.9, 1, Joining::turn}).turned, 0u);
        EXPECT_EQ(combined(network, {3.1, 1, Joining::turn}).turned, 1u);
        EXPECT_LT(angle_between(network[0], network[1]), 1e-13);
        if (!polygons) continue;
        EXPECT_GT(plane_of(network[1]).normal.z(), 0); // corners still run anticlockwise about the upward normal
        const Fracture again = polygon_fracture(network[1].corners);
        EXPECT_NEAR(again.disc.dip, network[1].disc.dip, 1e-12);
        EXPECT_NEAR(again.disc.dip_direction, network[1].disc.dip_direction, 1e-12);
        EXPECT_NEAR(area_of(again), area_of(network[1]), 1e-13 * area_of(again));
    }
}

TEST(FractureCombine, MergesKeepTheAreaOfThoseThatOverlap) {
    const Fracture large{{{0, 0, 0}, 0, 0, 10}};
    const auto merged = [&](const Fracture& other) {
        Network network{large, other};
        number(network);
        const Combined done = combined(network, {10, 1, Joining::merge});
        EXPECT_EQ(done.turned, 1u);
        return std::pair(done.taken_up.size(), network[0].disc.diameter);
    };
    EXPECT_EQ(merged({{{1, 1, 0.5}, 5, 0, 4}}), std::pair(std::size_t{1}, 10.0));             // inside
    EXPECT_EQ(merged({{{6, 0, 0.5}, 5, 0, 4}}), std::pair(std::size_t{1}, std::sqrt(116.0))); // overlaps
    EXPECT_EQ(merged({{{7.1, 0, 0.5}, 5, 0, 4}}), std::pair(std::size_t{0}, 10.0));           // next to it
    const Fracture square =
        polygon_fracture({{4, 4, 0.1}, {6, 4, 0.1}, {6, 6, 0.1}, {4, 6, 0.1}}); // its corner is 5.66 off
    EXPECT_EQ(merged(square).first, 0u);
    const Fracture nearer = polygon_fracture({{3, 3, 0.1}, {5, 3, 0.1}, {5, 5, 0.1}, {3, 5, 0.1}});
    const auto [taken, diameter] = merged(nearer);
    EXPECT_EQ(taken, 1u);
    EXPECT_NEAR(diameter * diameter, 100 + 4 * 4 / std::numbers::pi, 1e-12);
}

/// The first of both after a merge into the convex hull.
Fracture hull_of(const Fracture& large, const Fracture& other, int sides = 12) {
    Network network{large, other};
    number(network);
    const Combined done = combined(network, {10, 1, Joining::hull, sides});
    EXPECT_EQ(done.turned, 1u);
    EXPECT_EQ(done.moved, 0u);
    EXPECT_EQ(done.taken_up.size(), 1u);
    EXPECT_EQ(network[0].id, 1);
    return network[0];
}

Fracture square(double x, double y, double z, double side) {
    return polygon_fracture({{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}});
}

TEST(FractureCombine, HullsOfTwoFractures) {
    Fracture large = square(0, 0, 0, 2.5);
    large.groups = {"set=main"};
    const Fracture wide = hull_of(large, square(2, 0, 0.5, 2.5)); // their level sides are on two lines
    EXPECT_EQ(wide.corners.size(), 4u);
    EXPECT_NEAR(area_of(wide), 4.5 * 2.5, 1e-14);
    EXPECT_EQ(wide.groups, large.groups);
    EXPECT_LT((wide.disc.centre - Vec3(2.25, 1.25, 0)).norm(), 1e-14);
    const Fracture six = hull_of(square(0, 0, 0, 2), square(1, 1, 0.3, 2));
    EXPECT_EQ(six.corners.size(), 6u);
    EXPECT_NEAR(area_of(six), 9 - 2 * 0.5, 1e-14);
    const Fracture disc{{{0, 0, 0}, 30, 90, 10}};
    EXPECT_EQ(hull_of(disc, {{{1, 1, -0.5}, 30, 95, 4}}), hull_of(disc, {{{0, 1, -0.5}, 30, 95, 4}})); // inside
    EXPECT_TRUE(hull_of(disc, {{{1, 1, -0.5}, 30, 95, 4}}).corners.empty());
    Network apart{disc, {{{0, 7.1, 0.5}, 30, 90, 4}}};
    number(apart);
    EXPECT_TRUE(combined(apart, {10, 1, Joining::hull}).taken_up.empty());
    EXPECT_EQ(apart[0].disc, disc.disc);
}

/// Two discs of radii R and r at a distance d: their hull is R^2 (pi - a) + r^2 a + (R + r) d sin a, with cos a = (R - r) / d.
TEST(FractureCombine, HullsOfDiscs) {
    const double d = 6, angle = std::acos((5 - 2) / d);
    const double exact = 25 * (std::numbers::pi - angle) + 4 * angle + 7 * d * std::sin(angle);
    for (const auto& [sides, error] : {std::pair(12, 0.01), std::pair(24, 0.003), std::pair(64, 0.0005)}) {
        const Fracture hull = hull_of({{{0, 0, 0}, 30, 90, 10}}, {{{0, d, 0}, 30, 90, 4}}, sides);
        EXPECT_NEAR(area_of(hull) / exact, 1, error) << sides;
    }
}

TEST(FractureCombine, HullsInRandomNetworks) {
    std::size_t grown = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Network network = random_network(seed, 200);
        const Network before = network;
        const Combined done = combined(network, {8, 0.4, Joining::hull});
        for (std::size_t i = 0; i < network.size(); ++i) {
            const Fracture& after = network[i];
            if (area_of(after) < area_of(before[i]) * (1 + 1e-9)) continue;
            ++grown;
            EXPECT_LT(angle_between(after, before[i]), 1e-10);
            EXPECT_NEAR(area_within(after, outline_of(before[i], 12)), area_of(before[i]), 1e-9 * area_of(after));
            const Fracture again = polygon_fracture(after.corners); // plane and convex
            EXPECT_NEAR(area_of(again), area_of(after), 1e-13 * area_of(after));
            EXPECT_LT((again.disc.centre - after.disc.centre).norm(), 1e-12);
        }
        ASSERT_GT(done.taken_up.size(), 3u);
    }
    EXPECT_GT(grown, 20u);
}

TEST(FractureCombine, AreasAddUpInRandomNetworks) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        for (const Joining joining : {Joining::turn, Joining::collapse}) {
            Network network = random_network(seed, 200);
            const Network before = network;
            const Combined done = combined(network, {8, 0.4, joining});
            ASSERT_GT(done.turned, 20u);
            for (std::size_t i = 0; i < network.size(); ++i) {
                EXPECT_NEAR(area_of(network[i]), area_of(before[i]), 1e-12 * area_of(before[i]));
                const double moved = (network[i].disc.centre - before[i].disc.centre).norm();
                EXPECT_LE(moved, joining == Joining::turn ? 0 : 0.4 * (1 + 1e-12));
                EXPECT_LE(angle_between(network[i], before[i]), 8 * (1 + 1e-12));
            }
        }
        Network network = random_network(seed, 200);
        const double area = whole_area(network);
        const Combined done = combined(network, {8, 0.4, Joining::merge});
        ASSERT_GT(done.taken_up.size(), 3u);
        double rest = whole_area(network), taken = 0;
        for (const Fracture* fracture : done.taken_up) taken += area_of(*fracture);
        rest -= taken;
        EXPECT_LE(rest, area * (1 + 1e-12)); // those inside of larger ones are gone
        EXPECT_GE(rest, area - taken - 1e-9);
    }
}

namespace {

void expect_the_same_in_frames(const Combining& how, Network given) {
    Network network = given;
    const Combined expected = combined(network, how);
    ASSERT_GT(expected.taken_up.size(), 3u);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(0.2, -0.4, 1).normalized()).toRotationMatrix();
    Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
    mirror(0, 0) = -1;
    struct Frame {
        Eigen::Matrix3d linear;
        double scale;
        Vec3 shift;
    };
    for (const auto& [linear, scale, shift] :
         {Frame{turn, 1, Vec3(0, 0, 0)}, Frame{mirror, 1, Vec3(0, 0, 0)},
          Frame{Eigen::Matrix3d::Identity(), 1000, Vec3(0, 0, 0)}, Frame{turn * mirror, 0.001, Vec3(5, -7, 3)},
          Frame{turn, 1, Vec3(1e6, -2e6, 5e5)}}) {
        Network moved = given;
        for (Fracture& fracture : moved) {
            set_normal(fracture.disc, linear * normal_of(fracture.disc));
            fracture.disc.centre = scale * linear * fracture.disc.centre + shift;
            fracture.disc.diameter *= scale;
            for (Vec3& corner : fracture.corners) corner = scale * linear * corner + shift;
            if (!fracture.corners.empty() && area_vector_up(fracture.corners) < 0)
                std::ranges::reverse(fracture.corners);
        }
        const Combined done = combined(moved, {how.angle, how.distance * scale, how.joining});
        EXPECT_EQ(done.turned, expected.turned);
        ASSERT_EQ(done.taken_up.size(), expected.taken_up.size());
        for (std::size_t i = 0; i < done.taken_up.size(); ++i)
            EXPECT_EQ(done.taken_up[i]->id, expected.taken_up[i]->id);
        for (std::size_t i = 0; i < moved.size(); ++i)
            EXPECT_NEAR(moved[i].disc.diameter, scale * network[i].disc.diameter, 1e-8 * moved[i].disc.diameter);
    }
    std::ranges::reverse(given); // the sizes are all different
    const Combined reversed = combined(given, how);
    EXPECT_EQ(reversed.turned, expected.turned);
    for (std::size_t i = 0; i < network.size(); ++i) EXPECT_EQ(given[network.size() - 1 - i], network[i]);
}

} // namespace

/// Turned, mirrored, far away, in other units and in another order the same fractures are put together.
TEST(FractureCombine, FramesUnitsAndOrderDoNotMatter) {
    Network network = random_network(21, 150);
    expect_the_same_in_frames({8, 0.4, Joining::merge}, network);
    for (Fracture& fracture : network) // the polygon for a disc follows its strike, which a general turn changes
        if (fracture.corners.empty()) {
            const std::int64_t id = fracture.id;
            fracture = polygon_fracture(outline_of(fracture, 8));
            fracture.id = id;
        }
    expect_the_same_in_frames({8, 0.4, Joining::hull}, network);
}
