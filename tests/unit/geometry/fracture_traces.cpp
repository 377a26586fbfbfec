#include "geometry/fractures/traces.hpp"

#include "geometry/fractures/growth.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;

namespace {

Fracture flat_disc(const Vec3& centre, double dip, double dip_direction, double diameter) {
    return {{centre, dip, dip_direction, diameter}};
}

std::vector<Fracture> drawn(double size, double count, std::uint64_t seed, double edge = 60) {
    FractureLaw law;
    law.size = FractureLaw::Size::uniform;
    law.sizes = {0.5 * size, 1.5 * size};
    Growth growth;
    growth.high = Vec3::Constant(edge);
    growth.target = count;
    std::vector<Fracture> fractures;
    for (const Disc& d : grow(law, growth, Random(seed))) fractures.push_back({d});
    return fractures;
}

double length_of_all(const std::vector<Segment>& segments) {
    double sum = 0;
    for (const Segment& s : segments) sum += s.length();
    return sum;
}

} // namespace

TEST(FractureTraces, ChordsOfDiscs) {
    const std::vector<Vec3> wall{{-10, 0, -10}, {10, 0, -10}, {10, 0, 10}, {-10, 0, 10}};
    EXPECT_NEAR(length_of_all(traces_on(wall, flat_disc({0, 0, 0}, 0, 0, 4))), 4, 1e-14);
    EXPECT_NEAR(length_of_all(traces_on(wall, flat_disc({0, 1, 0}, 0, 0, 4))), 2 * std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(length_of_all(traces_on(wall, flat_disc({9, 0, 0}, 0, 0, 4))), 3, 1e-14); // ends at the edge
    EXPECT_TRUE(traces_on(wall, flat_disc({0, 2.1, 0}, 0, 0, 4)).empty());
    EXPECT_TRUE(traces_on(wall, flat_disc({0, 0, 0}, 90, 0, 4)).empty()); // lies in the wall
    // A wall with a notch: two traces.
    const std::vector<Vec3> notched{{-10, 0, -10}, {10, 0, -10}, {10, 0, 10}, {1, 0, 10},
                                    {1, 0, -5},    {-1, 0, -5},  {-1, 0, 10}, {-10, 0, 10}};
    const auto traces = traces_on(notched, flat_disc({0, 0, 0}, 0, 0, 4));
    ASSERT_EQ(traces.size(), 2u);
    EXPECT_NEAR(length_of_all(traces), 2, 1e-14);
}

/// P21 of discs of uniform orientation is P32 times pi/4 (Dershowitz and Herda 1992), and a chord of a disc is pi/4 of its diameter in the
/// mean; discs meet a plane with a probability that grows with their diameter.
TEST(FractureTraces, DensitiesOnPlanesFollowFromThoseInVolumes) {
    const auto fractures = drawn(3, 10'000, 31);
    double p32 = 0, squares = 0, diameters = 0;
    for (const Fracture& f : fractures) {
        p32 += area_of(f) / std::pow(60.0, 3);
        squares += f.disc.diameter * f.disc.diameter;
        diameters += f.disc.diameter;
    }
    TraceMeasures sums;
    std::vector<double> of_planes;
    for (int axis = 0; axis < 3; ++axis)
        for (double at = 5; at <= 55; at += 5) { // 2.25 from the sides of the box nothing is missing
            std::vector<Vec3> wall(4, Vec3::Zero());
            for (int k = 0; k < 4; ++k) {
                wall[static_cast<std::size_t>(k)][axis] = at;
                wall[static_cast<std::size_t>(k)][(axis + 1) % 3] = k == 1 || k == 2 ? 57 : 3;
                wall[static_cast<std::size_t>(k)][(axis + 2) % 3] = k > 1 ? 57 : 3;
            }
            const TraceMeasures one = trace_measures({wall}, fractures);
            of_planes.push_back(one.length / one.area);
            sums.area += one.area, sums.length += one.length, sums.number += one.number, sums.centres += one.centres;
        }
    double mean = 0, variance = 0;
    for (const double p21 : of_planes) mean += p21 / static_cast<double>(of_planes.size());
    for (const double p21 : of_planes) variance += std::pow(p21 - mean, 2);
    const double error = std::sqrt(variance) / static_cast<double>(of_planes.size());
    EXPECT_NEAR(mean, std::numbers::pi / 4 * p32, 4.9 * error);
    EXPECT_LT(error, 0.02 * mean);
    // Traces per area: the mean height of a disc, pi/4 of its diameter, times discs per volume.
    const double p20 = std::numbers::pi / 4 * diameters / std::pow(60.0, 3);
    EXPECT_NEAR(static_cast<double>(sums.centres) / sums.area, p20, 4.9 * std::sqrt(p20 / sums.area));
    EXPECT_NEAR(std::numbers::pi / 4 * p32 / p20, std::numbers::pi / 4 * squares / diameters,
                1e-9 * squares / diameters); // the mean trace
}

TEST(FractureTraces, IntersectionsOfTwoAreTheSameFromBothSides) {
    // Two discs at right angles through each other's centres, and one that ends at the first.
    const std::vector<Fracture> three{flat_disc({0, 0, 0}, 0, 0, 4), flat_disc({1, 0, 0}, 90, 90, 6),
                                      flat_disc({0, 0, 3}, 90, 0, 5.9)};
    const auto found = intersections_of(three);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].fractures, (std::array<std::size_t, 2>{0, 1}));
    EXPECT_NEAR(found[0].line.length(), 2 * std::sqrt(3.0), 1e-14);
    EXPECT_EQ(found[1].fractures, (std::array<std::size_t, 2>{1, 2}));
    // Moved, turned and in other units they are the same.
    const auto fractures = drawn(6, 200, 33, 20);
    const auto first = intersections_of(fractures);
    ASSERT_GT(first.size(), 20u);
    double length = 0;
    for (const auto& one : first) length += one.line.length();
    struct Motion {
        double scale, turn;
        Vec3 shift;
    };
    for (const Motion& m :
         {Motion{1, 0, {1e6, -1e6, 1e6}}, {1, 70, {0, 0, 0}}, {1e3, 0, {0, 0, 0}}, {1e-3, 200, {1, 2, 3}}}) {
        std::vector<Fracture> moved = fractures;
        for (Fracture& f : moved) {
            f.disc.centre =
                m.scale * (Eigen::AngleAxisd(m.turn * std::numbers::pi / 180, Vec3::UnitZ()) * f.disc.centre) + m.shift;
            f.disc.dip_direction -= m.turn;
            f.disc.diameter *= m.scale;
        }
        double sum = 0;
        const auto again = intersections_of(moved);
        for (const auto& one : again) sum += one.line.length();
        EXPECT_EQ(again.size(), first.size());
        EXPECT_NEAR(sum / m.scale, length, 1e-7 * length);
        EXPECT_EQ(clusters_of(200, again), clusters_of(200, first));
    }
}

/// Without a direction, volume density of intersections of discs is pi/8 P32 squared (n discs per volume of the same law: pi P32^2 / 4 / 2).
TEST(FractureTraces, LengthOfIntersectionsFollowsFromTheDensity) {
    const auto fractures = drawn(4, 6'000, 35);
    const Vec3 low = Vec3::Constant(4), high = Vec3::Constant(56);
    const double density = p32(fractures, low, high);
    double inside = 0;
    std::size_t number = 0;
    for (const auto& meeting : intersections_of(fractures)) {
        const Vec3 middle = 0.5 * (meeting.line.from + meeting.line.to);
        if ((middle - low).minCoeff() < 0 || (high - middle).minCoeff() < 0) continue;
        inside += meeting.line.length();
        ++number;
    }
    const double p31 = std::numbers::pi / 8 * density * density;
    EXPECT_NEAR(inside / std::pow(52.0, 3), p31, 4.9 * p31 * 1.5 / std::sqrt(static_cast<double>(number)));
}

TEST(FractureTraces, ClustersAreOrderedBySize) {
    std::vector<Fracture> chain;
    for (int k = 0; k < 3; ++k) chain.push_back(flat_disc({10.0 + k, 0, 0}, 90, k % 2 ? 90 : 0, 3)); // of three
    chain.insert(chain.begin(), flat_disc({50, 0, 0}, 0, 0, 1));                                     // alone
    for (int k = 0; k < 2; ++k) chain.push_back(flat_disc({30.0 + k, 0, 0}, 90, k % 2 ? 90 : 0, 3)); // of two
    const auto clusters = clusters_of(chain.size(), intersections_of(chain));
    EXPECT_EQ(clusters, (std::vector<std::size_t>{2, 0, 0, 0, 1, 1}));
}

namespace {

Vec3 uniform_direction(Random& random) {
    const double z = random.symmetric(), turn = 2 * std::numbers::pi * random.uniform(), r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

} // namespace

/// The mean volume in which the centre of a disc lies if it meets another one, by a hundred thousand pairs.
TEST(Percolation, ExcludedVolumeIsThatOfPairsThatMeet) {
    Random random(31);
    const double radius = 1.5, side = 4 * radius;
    std::size_t meet = 0;
    constexpr std::size_t pairs = 100'000;
    for (std::size_t k = 0; k < pairs; ++k) {
        Fracture one{{Vec3::Zero(), 0, 0, 2 * radius}}, other = one;
        set_normal(one.disc, uniform_direction(random));
        set_normal(other.disc, uniform_direction(random));
        other.disc.centre = 0.5 * side * Vec3(random.symmetric(), random.symmetric(), random.symmetric());
        meet += intersections_of({one, other}).size();
    }
    const double share = excluded_volume(radius) / std::pow(side, 3);
    EXPECT_NEAR(static_cast<double>(meet) / pairs, share, 4.9 * std::sqrt(share * (1 - share) / pairs));
}

TEST(Percolation, SidesOfABoxCountInThreeWays) {
    const Vec3 low = Vec3::Zero(), high = Vec3::Constant(10);
    const double pi = std::numbers::pi, whole = pi * pi * 8 / 1000;
    const Fracture inside{{{5, 5, 5}, 30, 40, 4}}, half{{{0, 5, 5}, 0, 0, 4}}, outside{{{-3, 5, 5}, 0, 0, 4}};
    for (const AtSides way : {AtSides::nothing, AtSides::area_inside, AtSides::scaled_radius}) {
        EXPECT_NEAR(percolation({inside}, low, high, way), whole, 1e-15);
        EXPECT_LT(percolation({outside}, low, high, way), 1e-15 * whole);
        // In other units the same number.
        const Fracture larger{{{5000, 5000, 5000}, 30, 40, 4000}};
        EXPECT_NEAR(percolation({larger}, low, 1000 * high, way), whole, 1e-15);
        // A polygon has the radius of the disc of its area.
        const Fracture square = polygon_fracture(outline_of(inside, 4));
        EXPECT_NEAR(percolation({square}, low, high, way), whole, 1e-14);
    }
    EXPECT_EQ(percolation({half}, low, high, AtSides::nothing), 0);
    EXPECT_NEAR(percolation({half, inside}, low, high, AtSides::area_inside), whole * (1 + std::pow(0.5, 1.5)), 1e-15);
    EXPECT_NEAR(percolation({half, inside}, low, high, AtSides::scaled_radius), whole * 1.125, 1e-15);
}

TEST(Percolation, NetworksGrowUntilItIsReached) {
    FractureLaw law;
    law.size = FractureLaw::Size::power_law;
    law.exponent = 3.5;
    law.sizes = {1, 12};
    Growth growth;
    growth.high = Vec3(40, 30, 20);
    growth.until = Growth::Until::percolation;
    growth.target = 2.5;
    std::vector<Fracture> fractures;
    double sum = 0, largest = 0;
    for (const Disc& disc : grow(law, growth, Random(4))) {
        fractures.push_back({disc});
        sum += excluded_volume(0.5 * disc.diameter) / 24'000;
        largest = std::max(largest, disc.diameter);
    }
    EXPECT_NEAR(sum, 2.5, 0.5 * excluded_volume(0.5 * 12) / 24'000);
    // In a box that holds all of them, with the same volume.
    const Vec3 low = Vec3::Constant(-largest), high = growth.high + Vec3::Constant(largest);
    EXPECT_NEAR(percolation(fractures, low, high, AtSides::nothing) * (high - low).prod(), 24'000 * sum, 1e-9 * 24'000);
}
