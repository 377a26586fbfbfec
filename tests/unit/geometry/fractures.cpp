#include "geometry/fractures/growth.hpp"

#include "base/diagnostic.hpp"
#include "geometry/read/read_fractures.hpp"
#include "geometry/polyhedra/plane.hpp"
#include "geometry/surface/block_cuts.hpp"
#include "geometry/surface/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

using namespace kaya;

namespace {

constexpr double pi = std::numbers::pi;

Growth of_count(double count) {
    Growth growth;
    growth.high = Vec3::Constant(100);
    growth.target = count;
    return growth;
}

FractureLaw sizes(FractureLaw::Size size, double first, double second, Interval limits) {
    FractureLaw law;
    law.size = size;
    law.exponent = law.mean = first;
    law.deviation = second;
    law.sizes = limits;
    return law;
}

double mean_of(const std::vector<Disc>& discs, const std::function<double(const Disc&)>& value) {
    double sum = 0;
    for (const Disc& disc : discs) sum += value(disc);
    return sum / static_cast<double>(discs.size());
}

double deviation_of(const std::vector<Disc>& discs, const std::function<double(const Disc&)>& value) {
    const double mean = mean_of(discs, value);
    return std::sqrt(mean_of(discs, [&](const Disc& d) { return std::pow(value(d) - mean, 2); }));
}

constexpr double whole = 10'000;
/// Of a mean of `whole` values: exceeded once in a million.
constexpr double confidence = 4.9;

} // namespace

TEST(Fractures, AreaInABoxOfKnownParts) {
    const Vec3 low = Vec3::Zero(), high = Vec3::Constant(10);
    for (const double dip : {0., 30., 45., 90.})
        for (const double dd : {0., 77., 180., 301.}) {
            const Disc inside{{5, 5, 5}, dip, dd, 4};
            EXPECT_NEAR(area_in_box(inside, low, high), 4 * pi, 1e-13 * 4 * pi);
            const Disc large{{5, 5, 5}, dip, dd, 100}; // the box cuts a polygon from its plane
            const Vec3 normal = normal_of(large);
            if (dip == 0) { EXPECT_NEAR(area_in_box(large, low, high), 100, 1e-11); }
            if (dip == 30 && dd == 0) { EXPECT_NEAR(area_in_box(large, low, high), 100 / normal.z(), 1e-11); }
        }
    EXPECT_NEAR(area_in_box({{0, 5, 5}, 0, 0, 4}, low, high), 2 * pi, 1e-13); // half
    EXPECT_NEAR(area_in_box({{0, 0, 5}, 0, 0, 4}, low, high), pi, 1e-13);     // a quarter
    EXPECT_NEAR(area_in_box({{0, 0, 0}, 45, 0, 4}, low, high), 0, 1e-12);     // an edge only
    EXPECT_EQ(area_in_box({{20, 5, 5}, 90, 90, 4}, low, high), 0);
    // A circular segment: radius 2, cut at 1 from the centre.
    EXPECT_NEAR(area_in_box({{-1, 5, 5}, 0, 0, 4}, low, high), 4 * std::acos(0.5) - std::sqrt(3.0), 1e-13);
}

TEST(Fractures, PartsOfABoxAddUpWhateverItsPlace) {
    Random random(3);
    for (int k = 0; k < 500; ++k) {
        const Vec3 shift = std::pow(10.0, 6 * random.uniform()) * Vec3(1, -2, 0.5);
        const Disc disc{shift + 10 * Vec3(random.uniform(), random.uniform(), random.uniform()), 90 * random.uniform(),
                        360 * random.uniform(), 0.1 + 20 * random.uniform()};
        const Vec3 low = shift, high = shift + Vec3::Constant(10);
        double parts = 0;
        const Vec3 middle = low + 10 * Vec3(random.uniform(), random.uniform(), random.uniform());
        for (int i = 0; i < 8; ++i) {
            Vec3 from = low, to = middle;
            for (int axis = 0; axis < 3; ++axis)
                if (i >> axis & 1) {
                    from[axis] = middle[axis];
                    to[axis] = high[axis];
                }
            parts += area_in_box(disc, from, to);
        }
        const double all = area_in_box(disc, low, high), round_off = 1e-14 * (1 + shift.norm()) * disc.diameter;
        EXPECT_NEAR(parts, all, 1e-11 * disc.diameter * disc.diameter + 100 * round_off) << k;
        EXPECT_LE(all, pi / 4 * disc.diameter * disc.diameter * (1 + 1e-12));
    }
}

TEST(Fractures, LinesCrossDiscs) {
    const Disc level{{1, 2, 3}, 0, 0, 2};
    EXPECT_TRUE(crosses(level, {1.9, 2, 0}, {1.9, 2, 9}));
    EXPECT_FALSE(crosses(level, {2.1, 2, 0}, {2.1, 2, 9}));
    EXPECT_FALSE(crosses(level, {1, 2, 0}, {1, 2, 2.9}));
    EXPECT_DOUBLE_EQ(p10(std::vector{level, level, Disc{{1, 2, 30}, 0, 0, 2}}, {1, 2, 0}, {1, 2, 10}), 0.2);
}

/// The mean of the normals of Fisher's distribution has the length coth kappa - 1/kappa.
TEST(Fractures, OrientationsHaveTheirMeans) {
    for (const double kappa : {2.0, 20.0, 300.0})
        for (const auto& [dip, dd] : {std::pair{0., 0.}, {35., 120.}, {88., 300.}}) {
            FractureLaw law = sizes(FractureLaw::Size::exponential, 5, 0, {0, 1e9});
            law.orientation = FractureLaw::Orientation::fisher;
            law.kappa = kappa;
            law.dip = dip;
            law.dip_direction = dd;
            const auto discs = grow(law, of_count(whole), Random(17));
            ASSERT_EQ(discs.size(), whole);
            const Vec3 axis = normal_of({{}, dip, dd, 1});
            // Normals point upward; their sign does not matter here.
            const auto cosine = [&](const Disc& d) { return std::pow(normal_of(d).dot(axis), 2); };
            const double expected = 1 - 2 / kappa * (1 / std::tanh(kappa) - 1 / kappa); // of the square of the cosine
            EXPECT_NEAR(mean_of(discs, cosine), expected, confidence * deviation_of(discs, cosine) / std::sqrt(whole));
            // Around the mean no direction is preferred.
            const Vec3 side = axis.unitOrthogonal();
            const auto skew = [&](const Disc& d) {
                const Vec3 n = normal_of(d);
                return n.dot(axis) * n.dot(side);
            };
            EXPECT_NEAR(mean_of(discs, skew), 0, confidence * deviation_of(discs, skew) / std::sqrt(whole));
        }
    const FractureLaw uniform = sizes(FractureLaw::Size::exponential, 5, 0, {0, 1e9});
    const auto discs = grow(uniform, of_count(whole), Random(18));
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1).normalized()}) {
        const auto square = [&](const Disc& d) { return std::pow(normal_of(d).dot(axis), 2); };
        EXPECT_NEAR(mean_of(discs, square), 1.0 / 3, confidence * std::sqrt(4.0 / 45 / whole));
    }
}

TEST(Fractures, SizesHaveTheirMeansAndLimits) {
    using enum FractureLaw::Size;
    struct Row {
        FractureLaw law;
        double mean, deviation;
    };
    const auto power_moment = [](double a, double low, double high, double order) { // of the diameter to that power
        const auto integral = [&](double b) {
            return b == -1 ? std::log(high / low) : (std::pow(high, b + 1) - std::pow(low, b + 1)) / (b + 1);
        };
        return integral(order - a) / integral(-a);
    };
    std::vector<Row> rows{{sizes(uniform, 0, 0, {2, 8}), 5, 6 / std::sqrt(12.0)},
                          {sizes(gauss, 50, 4, {1e-9, 1e9}), 50, 4},
                          {sizes(log_normal, 5, 2, {1e-9, 1e9}), 5, 2},
                          {sizes(exponential, 7, 0, {0, 1e9}), 7, 7}};
    for (const double a : {1.0, 2.0, 3.5}) {
        const double mean = power_moment(a, 1, 40, 1);
        rows.push_back({sizes(power_law, a, 0, {1, 40}), mean, std::sqrt(power_moment(a, 1, 40, 2) - mean * mean)});
    }
    for (const Row& row : rows) {
        const auto discs = grow(row.law, of_count(whole), Random(19));
        const auto diameter = [](const Disc& d) { return d.diameter; };
        EXPECT_NEAR(mean_of(discs, diameter), row.mean, confidence * row.deviation / std::sqrt(whole));
        EXPECT_NEAR(deviation_of(discs, diameter), row.deviation, 0.12 * row.deviation);
        for (const Disc& d : discs) EXPECT_TRUE(row.law.sizes.hold(d.diameter));
    }
    // Without a greatest size: the share above x is x^(1 - a).
    const auto tail =
        grow(sizes(power_law, 3, 0, {1, std::numeric_limits<double>::infinity()}), of_count(whole), Random(20));
    const auto above = std::ranges::count_if(tail, [](const Disc& d) { return d.diameter > 3; });
    EXPECT_NEAR(static_cast<double>(above) / whole, 1.0 / 9, confidence * std::sqrt(1.0 / 9 * 8 / 9 / whole));
}

/// Lines cross discs of uniform orientation P32 / 2 times per length (Dershowitz and Herda 1992).
TEST(Fractures, DensitiesAreReached) {
    FractureLaw law = sizes(FractureLaw::Size::uniform, 0, 0, {2, 6});
    Growth growth = of_count(1);
    growth.low = Vec3::Constant(-10);
    growth.high = Vec3::Constant(50);
    growth.until = Growth::Until::area;
    growth.target = 0.6;
    const auto discs = grow(law, growth, Random(21));
    const double largest = pi * 9 / std::pow(60.0, 3);
    EXPECT_NEAR(p32(discs, growth.low, growth.high), 0.6, largest);
    // Away from the edges of the box of centres the density is that of all discs over its volume.
    double area = 0;
    for (const Disc& disc : discs) area += pi / 4 * disc.diameter * disc.diameter;
    const double inner = p32(discs, Vec3::Constant(-7), Vec3::Constant(47));
    EXPECT_NEAR(inner, area / std::pow(60.0, 3), 0.02 * inner);
    double crossings = 0;
    int lines = 0;
    for (double a = -6; a < 47; a += 2.6)
        for (double b = -6; b < 47; b += 2.6)
            for (int axis = 0; axis < 3; ++axis, ++lines) {
                Vec3 begin, end;
                begin[axis] = -7, end[axis] = 47;
                begin[(axis + 1) % 3] = end[(axis + 1) % 3] = a;
                begin[(axis + 2) % 3] = end[(axis + 2) % 3] = b;
                crossings += p10(discs, begin, end);
            }
    EXPECT_NEAR(crossings / lines, inner / 2, 0.02 * inner / 2);

    growth.until = Growth::Until::crossings;
    growth.target = 0.5;
    growth.begin = {20, 20, -10};
    growth.end = {20, 20, 50};
    EXPECT_NEAR(p10(grow(law, growth, Random(22)), growth.begin, growth.end), 0.5, 0.5 / 60 + 1e-12);
}

TEST(Fractures, SeedsAndStreams) {
    const FractureLaw law = sizes(FractureLaw::Size::uniform, 0, 0, {2, 6});
    EXPECT_EQ(grow(law, of_count(50), Random(1)), grow(law, of_count(50), Random(1)));
    EXPECT_NE(grow(law, of_count(50), Random(1)), grow(law, of_count(50), Random(2)));
    EXPECT_NE(grow(law, of_count(50), Random(1, 50)), grow(law, of_count(50), Random(1)));
}

TEST(Fractures, LawsThatGiveNothingAreRefused) {
    using enum FractureLaw::Size;
    const auto message = [](const FractureLaw& law) {
        try {
            grow(law, of_count(3), Random(1));
        } catch (const Diagnostic& refused) { return refused.message; }
        return std::string("none");
    };
    constexpr double open = std::numeric_limits<double>::infinity();
    EXPECT_EQ(message(sizes(uniform, 0, 0, {1, open})), "sizes that are uniform need their limits");
    EXPECT_EQ(message(sizes(power_law, 1, 0, {1, open})),
              "a power law with the exponent 1 has no mean without a greatest size");
    EXPECT_EQ(message(sizes(gauss, 1, 0.1, {5, 6})), "of 100000 values for the size none is from 5 to 6");
    EXPECT_EQ(message(sizes(gauss, 1, 0.1, {6, 5})), "the limits of sizes are 6 and 5: the first is the greater one");
    FractureLaw law = sizes(uniform, 0, 0, {1, 2});
    law.orientation = FractureLaw::Orientation::gauss;
    law.dip = 20;
    law.dips = {40, 50};
    EXPECT_EQ(message(law), "of 100000 values for the dip none is from 40 to 50");
}

namespace {

/// Of each kind, around north.
std::vector<FractureLaw> laws_around_north() {
    using enum FractureLaw::Orientation;
    std::vector<FractureLaw> laws;
    for (const auto orientation : {uniform, fisher, gauss, bootstrapped}) {
        FractureLaw law = sizes(FractureLaw::Size::uniform, 0, 0, {1, 2});
        law.orientation = orientation;
        law.dip = 50, law.dip_direction = 5;
        law.kappa = 8;
        law.dip_deviation = 10, law.dip_direction_deviation = 40;
        for (int k = 0; k < 36; ++k) law.planes.add({60, 10.0 * k});
        laws.push_back(law);
    }
    return laws;
}

} // namespace

/// Limits of directions are an arc, however it is written.
TEST(Fractures, LimitsOfDirectionsCrossNorth) {
    for (FractureLaw law : laws_around_north())
        for (const auto& [low, high] :
             {std::pair{330.0, 390.0}, {40.0, 60.0}, {300.0, 420.0}, {90.0, 270.0}, {170.0, 520.0}})
            for (const std::uint64_t seed : {1, 2, 3}) {
                law.dip_directions = {low, high};
                const auto discs = grow(law, of_count(100), Random(seed));
                ASSERT_EQ(discs.size(), 100U);
                for (const Disc& disc : discs) {
                    const double from_low = std::fmod(disc.dip_direction - low + 720, 360);
                    EXPECT_TRUE(from_low <= high - low + 1e-8 || from_low > 360 - 1e-8)
                        << low << ' ' << disc.dip_direction;
                }
                for (const auto& [a, b] : {std::pair{low - 360, high - 360},
                                           {low, high - 360},
                                           {low - 720, high - 720},
                                           {low + 360, high + 360},
                                           {low + 360, high}}) {
                    if (b - a <= -360) continue;
                    law.dip_directions = {a, b};
                    EXPECT_EQ(grow(law, of_count(100), Random(seed)), discs) << a << ' ' << b;
                }
            }
}

TEST(Fractures, AllDirectionsAreAFullTurn) {
    for (FractureLaw law : laws_around_north()) {
        const auto all = grow(law, of_count(200), Random(4));
        for (const double low : {-360.0, -180.0, -30.0, 10.0, 360.0}) {
            law.dip_directions = {low, low + 360};
            EXPECT_EQ(grow(law, of_count(200), Random(4)), all);
        }
    }
}

/// Measured planes are often at the limits themselves.
TEST(Fractures, LimitsOfDirectionsHoldTheirEnds) {
    for (const auto& limits : {Directions{-29.9, 40.3}, {330.1, 400.3}, {330.1, 40.3}, {690.1, 760.3}}) {
        for (const double inside : {330.1, 0.0, 40.3, 360.0, -29.9}) EXPECT_TRUE(limits.hold(inside)) << inside;
        for (const double outside : {330.0, 40.4, 180.0}) EXPECT_FALSE(limits.hold(outside)) << outside;
    }
}

namespace {

std::vector<Fracture> read(std::string_view text, FractureFormat format = FractureFormat::discs) {
    return read_fractures(text, "a.txt", format);
}

std::string refusal(std::string_view text, FractureFormat format = FractureFormat::discs) {
    try {
        read(text, format);
    } catch (const Diagnostic& refused) { return refused.message; }
    return "none";
}

} // namespace

TEST(Fractures, FilesOfDiscs) {
    const auto fractures = read("x,y,z,dip,dd,diameter\n1, 2, 3, 30, 90, 4 # the first\n\n5;6;7;80;270;1.5\r\n");
    ASSERT_EQ(fractures.size(), 2u);
    EXPECT_EQ(fractures[0].disc, (Disc{{1, 2, 3}, 30, 90, 4}));
    EXPECT_EQ(fractures[1].disc, (Disc{{5, 6, 7}, 80, 270, 1.5}));
    EXPECT_EQ(refusal(""), "a.txt has no fractures");
    EXPECT_EQ(refusal("x y z\n"), "a.txt has no fractures");
    EXPECT_EQ(refusal("1 2 3 30 90\n"), "a.txt, line 1: 5 words where a fracture has six numbers");
    EXPECT_EQ(refusal("1 2 3 30 90 nan\n"), "a.txt, line 1: 'nan' is not a number");
    EXPECT_EQ(refusal("1 2 3 30 90 1e300\n"),
              "a.txt, line 1: the diameter of a fracture must be at most 1e+12, not 1e+300");
    EXPECT_EQ(refusal("1 2 3 30 90 1e999\n"), "a.txt, line 1: '1e999' is not a number");
    EXPECT_EQ(refusal("head\n1 2 3 30 90 -1\n"),
              "a.txt, line 2: the diameter of a fracture must be greater than 0, not -1");
}

TEST(Fractures, FilesOfPolygons) {
    using enum FractureFormat;
    const auto fractures =
        read("# two polygons\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n\npolygon 2\n0 0 5 # a remark\n# another\n0 3 5\n"
             "0 3 9\n",
             polygons);
    ASSERT_EQ(fractures.size(), 2u);
    EXPECT_EQ(fractures[0].corners.size(), 4u);
    EXPECT_NEAR(area_of(fractures[0]), 2, 1e-14);
    EXPECT_EQ(fractures[0].disc.dip, 0);
    EXPECT_EQ(fractures[1].corners.size(), 3u);
    EXPECT_NEAR(area_of(fractures[1]), 6, 1e-14);
    EXPECT_EQ(fractures[1].disc.dip, 90);
    EXPECT_EQ(refusal("", polygons), "a.txt has no fractures");
    EXPECT_EQ(refusal("0 0 0\n1 0 0\n", polygons),
              "a.txt, the polygon that ends in line 2: a polygon has three corners or more, not 2");
    EXPECT_EQ(refusal("0 0 0\n1 0 0 7\n", polygons), "a.txt, line 2: 4 words where a corner has three numbers");
    EXPECT_EQ(refusal("0 0 0\n1 0 nan\n", polygons), "a.txt, line 2: 'nan' is not a number");
    EXPECT_EQ(refusal("0 0 0\n2 0 0\n0.5 0.5 0\n0 2 0\n\n1 1 1\n", polygons),
              "a.txt, the polygon that ends in line 4: the polygon is not convex");
}

/// A trace is a diameter of its disc.
TEST(Fractures, FilesOfTraces) {
    using enum FractureFormat;
    const auto fractures = read("x1 y1 z1 x2 y2 z2\n0 0 0 0 4 0\n0 0 1 0 2 1 30 90\n0 0 0 0 0 3 90 45\n", traces);
    ASSERT_EQ(fractures.size(), 3u);
    EXPECT_EQ(fractures[0].disc.centre, Vec3(0, 2, 0));
    EXPECT_EQ(fractures[0].disc.diameter, 4);
    EXPECT_NEAR(fractures[0].disc.dip, 90, 1e-12);
    for (const Fracture& f : fractures) {
        const Vec3 normal = normal_of(f.disc);
        EXPECT_NEAR(normal.dot(f.disc.centre - Vec3(0, 0, f.disc.centre.z() == 1 ? 1 : 0)), 0, 1e-12);
    }
    EXPECT_NEAR(fractures[1].disc.dip, 30, 1e-12);
    EXPECT_NEAR(fractures[1].disc.dip_direction, 90, 1e-12);
    EXPECT_NEAR(std::fmod(fractures[2].disc.dip_direction, 180), 45, 1e-12);
    EXPECT_EQ(refusal("0 0 0 0 0 0\n", traces), "a.txt, line 1: the trace has no length");
    EXPECT_EQ(refusal("0 0 0 0 0 3\n", traces),
              "a.txt, line 1: an upright trace needs the dip and the dip direction of its fracture");
    EXPECT_EQ(refusal("0 0 0 0 4 0 30\n", traces), "a.txt, line 1: 7 words where a trace has six numbers or eight");
    EXPECT_EQ(
        refusal("0 0 0 4 0 0 90 90\n", traces),
        "a.txt, line 1: a fracture of dip 90 and dip direction 90 does not pass along the trace: it is 90 degrees off");
}

/// Every cut of a good file is read in part or refused with its line, never more.
TEST(Fractures, TruncatedFilesAreReadOrRefused) {
    const std::string discs = "1 2 3 30 90 4\n5 6 7 80 270 1.5\n",
                      polygons = "0 0 0\n2 0 0\n2 1 0\n\n0 0 5\n0 3 5\n0 3 9\n",
                      traces = "0 0 0 0 4 0\n0 0 1 0 2 1 30 90\n";
    int format = 0;
    for (const std::string& whole : {discs, polygons, traces}) {
        for (std::size_t end = 0; end < whole.size(); ++end) {
            const std::string message = refusal(whole.substr(0, end), static_cast<FractureFormat>(format));
            EXPECT_TRUE(message == "none" || message.starts_with("a.txt")) << message;
        }
        ++format;
    }
    std::string huge;
    for (int i = 0; i < 100'000; ++i) huge += "1 2 3 30 90 4\n";
    EXPECT_EQ(read(huge).size(), 100'000u);
}
