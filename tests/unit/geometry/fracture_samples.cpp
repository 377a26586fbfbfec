// Fractures drawn from measured orientations and sizes.
#include "base/diagnostic.hpp"
#include "geometry/fractures/growth.hpp"
#include "geometry/read/read_sample.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

using namespace kaya;

namespace {

constexpr double whole = 10'000;
/// In deviations: exceeded once in a million.
constexpr double confidence = 4.9;

/// 50 planes of two clusters and a girdle.
Sample<MeasuredPlane> fifty_planes() {
    Sample<MeasuredPlane> sample;
    Random random(50);
    for (int k = 0; k < 50; ++k) {
        const double dip = k < 20 ? 25 : k < 40 ? 70 : 85, direction = k < 20 ? 110 : k < 40 ? 310 : 7.2 * k;
        sample.add({dip + 4 * random.symmetric(), direction + 9 * random.symmetric()});
        if (sample.values.back().dip_direction >= 360) sample.values.back().dip_direction -= 360;
    }
    return sample;
}

FractureLaw law_of(const Sample<MeasuredPlane>& planes) {
    FractureLaw law;
    law.orientation = FractureLaw::Orientation::bootstrapped;
    law.planes = planes;
    law.size = FractureLaw::Size::exponential;
    law.mean = 4;
    return law;
}

std::vector<Disc> drawn(const FractureLaw& law, std::uint64_t seed, double count = whole) {
    Growth growth;
    growth.high = Vec3::Constant(100);
    growth.target = count;
    return grow(law, growth, Random(seed));
}

std::map<std::pair<double, double>, double> counts_of(const std::vector<Disc>& discs) {
    std::map<std::pair<double, double>, double> counts;
    for (const Disc& disc : discs) ++counts[{disc.dip, disc.dip_direction}];
    return counts;
}

/// That a share of `whole` differs from its probability by no more than chance.
void expect_share(double count, double probability) {
    EXPECT_NEAR(count / whole, probability, confidence * std::sqrt(probability * (1 - probability) / whole));
}

std::string refusal(const std::string& text, bool planes = true) {
    try {
        if (planes) read_planes(text, "f");
        else read_diameters(text, "f");
    } catch (const Diagnostic& refused) { return refused.message; }
    return "read";
}

} // namespace

TEST(FractureSamples, SharesAreThoseOfTheSample) {
    const auto sample = fifty_planes();
    const auto discs = drawn(law_of(sample), 7);
    ASSERT_EQ(discs.size(), whole);
    auto counts = counts_of(discs);
    double chi_square = 0;
    for (const MeasuredPlane& plane : sample.values) {
        const double count = counts[{plane.dip, plane.dip_direction}], expected = whole / 50;
        expect_share(count, 1.0 / 50);
        chi_square += (count - expected) * (count - expected) / expected;
    }
    EXPECT_EQ(counts.size(), 50u); // and no other plane
    // 49 degrees of freedom: mean 49, deviation sqrt(98). Below, the draws would not be independent.
    EXPECT_NEAR(chi_square, 49, confidence * std::sqrt(98.0));
    // The mean pole.
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero(), drawn_mean = Vec3::Zero();
    for (const MeasuredPlane& plane : sample.values) {
        const Vec3 pole = normal_of({{}, plane.dip, plane.dip_direction, 1});
        mean += pole / 50;
        square += pole.cwiseAbs2() / 50;
    }
    for (const Disc& disc : discs) drawn_mean += normal_of(disc) / whole;
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(drawn_mean[k], mean[k], confidence * std::sqrt((square[k] - mean[k] * mean[k]) / whole));
}

TEST(FractureSamples, DrawsFollowOneAnotherWithoutMemory) {
    const auto sample = fifty_planes();
    const auto discs = drawn(law_of(sample), 8);
    double same = 0;
    for (std::size_t i = 1; i < discs.size(); ++i)
        same += discs[i].dip == discs[i - 1].dip && discs[i].dip_direction == discs[i - 1].dip_direction;
    expect_share(same, 1.0 / 50);
}

TEST(FractureSamples, WeightsAreProbabilities) {
    Sample<MeasuredPlane> sample;
    sample.add({10, 20}, 1);
    sample.add({50, 200}, 6);
    sample.add({80, 355}, 3);
    auto counts = counts_of(drawn(law_of(sample), 9));
    expect_share(counts[{10, 20}], 0.1);
    expect_share(counts[{50, 200}], 0.6);
    expect_share(counts[{80, 355}], 0.3);
    // In other units the same planes are drawn.
    Sample<MeasuredPlane> scaled;
    for (std::size_t i = 0; i < 3; ++i) scaled.add(sample.values[i], std::array{0x1p-40, 6 * 0x1p-40, 3 * 0x1p-40}[i]);
    EXPECT_EQ(drawn(law_of(scaled), 9), drawn(law_of(sample), 9));
}

/// Turned about the vertical or mirrored at the plane of north and height, and in other lengths.
TEST(FractureSamples, DrawsFollowTheSample) {
    const auto sample = fifty_planes();
    FractureLaw law = law_of(sample);
    law.size = FractureLaw::Size::bootstrapped;
    law.sizes = {0, 1e12};
    for (int k = 1; k < 30; ++k) law.diameters.add(0.25 * k * k);
    const auto discs = drawn(law, 11, 500);
    FractureLaw turned = law, mirrored = law, larger = law;
    for (MeasuredPlane& plane : turned.planes.values) plane.dip_direction = std::fmod(plane.dip_direction + 90, 360);
    for (MeasuredPlane& plane : mirrored.planes.values) plane.dip_direction = 360 - plane.dip_direction;
    for (double& diameter : larger.diameters.values) diameter *= 1024;
    const auto of_turned = drawn(turned, 11, 500), of_mirrored = drawn(mirrored, 11, 500),
               of_larger = drawn(larger, 11, 500);
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Vec3 n = normal_of(discs[i]);
        EXPECT_LT((normal_of(of_turned[i]) - Vec3(n.y(), -n.x(), n.z())).norm(), 1e-14);
        EXPECT_LT((normal_of(of_mirrored[i]) - Vec3(-n.x(), n.y(), n.z())).norm(), 1e-14);
        EXPECT_EQ(of_larger[i].diameter, 1024 * discs[i].diameter);
    }
}

TEST(FractureSamples, OrderDoesNotChangeShares) {
    auto sample = fifty_planes();
    std::ranges::reverse(sample.values);
    auto counts = counts_of(drawn(law_of(sample), 7));
    for (const MeasuredPlane& plane : sample.values) expect_share(counts[{plane.dip, plane.dip_direction}], 1.0 / 50);
}

TEST(FractureSamples, LimitsLeaveARestOfTheSample) {
    FractureLaw law = law_of(fifty_planes());
    law.dips = {60, 90};
    law.dip_directions = {180, 360};
    const auto kept = [&](const MeasuredPlane& p) {
        return law.dips.hold(p.dip) && law.dip_directions.hold(p.dip_direction);
    };
    const auto left = static_cast<double>(std::ranges::count_if(law.planes.values, kept));
    ASSERT_GT(left, 1);
    ASSERT_LT(left, 50);
    auto counts = counts_of(drawn(law, 12));
    for (const MeasuredPlane& plane : law.planes.values)
        if (kept(plane)) expect_share(counts[{plane.dip, plane.dip_direction}], 1 / left);
        else EXPECT_EQ(counts.count({plane.dip, plane.dip_direction}), 0u);
    law.dips = {89.99, 90};
    EXPECT_THROW(check(law), Diagnostic);
}

TEST(FractureSamples, SizesAreMeasuredOnes) {
    FractureLaw law = law_of(fifty_planes());
    law.size = FractureLaw::Size::bootstrapped;
    law.sizes = {0, 1e12};
    law.diameters.add(0.3, 2);
    law.diameters.add(1.7, 1);
    law.diameters.add(40, 1);
    double small = 0;
    for (const Disc& disc : drawn(law, 13)) {
        EXPECT_TRUE(disc.diameter == 0.3 || disc.diameter == 1.7 || disc.diameter == 40);
        small += disc.diameter == 0.3;
    }
    expect_share(small, 0.5);
    law.sizes = {50, 60};
    EXPECT_THROW(check(law), Diagnostic);
}

TEST(FractureSamples, FilesOfPlanes) {
    Sample<MeasuredPlane> expected;
    expected.add({30, 120});
    expected.add({85.5, 350});
    for (const char* text :
         {"30 120\n85.5 -10\n", "dip dd\n30,120\n85.5;350\n", "30\t120 # wall\r\n\n# remark\n85.5 350",
          "; of the wall: id dip dd\n1;30;120\n2;85.5;350\n", "id dip dd weight\n17 30 120 1\n4 85.5 350 1\n"})
        EXPECT_EQ(read_planes(text, "f"), expected) << text;
    Sample<MeasuredPlane> weighted;
    weighted.add({30, 0}, 2);
    weighted.add({40, 10}, 0.5);
    EXPECT_EQ(read_planes("1 30 360 2\n2 35 5 0\n3 40 10 0.5\n", "f"), weighted);
    EXPECT_EQ(refusal(""), "f has no planes");
    EXPECT_EQ(refusal("dip dd\n"), "f has no planes");
    EXPECT_EQ(refusal("30\n"), "f, line 1: 1 words where a plane has 2 to 4 numbers");
    EXPECT_EQ(refusal("30 120\n1 2 3 4 5\n"), "f, line 2: 5 words where a plane has 2 to 4 numbers");
    EXPECT_EQ(refusal("30 120\n1 30 120\n"), "f, line 2: 3 words, and 2 in the lines above");
    EXPECT_EQ(refusal("30 120\nx 120\n"), "f, line 2: 'x' is not a number");
    EXPECT_EQ(refusal("30 nan\n"), "f, line 1: 'nan' is not a number");
    EXPECT_EQ(refusal("\n91 120\n"), "f, line 2: a dip must be from 0 to 90 degrees, not 91");
    EXPECT_EQ(refusal("-1 120\n"), "f, line 1: a dip must be from 0 to 90 degrees, not -1");
    EXPECT_EQ(refusal("30 361\n"), "f, line 1: a dip direction must be from -360 to 360 degrees, not 361");
    EXPECT_EQ(refusal("1 30 120 -1\n"), "f, line 1: a weight must be from 0 to 1e12, not -1");
    EXPECT_EQ(refusal("1 30 120 0\n"), "all weights in f are 0");
}

TEST(FractureSamples, FilesOfSizes) {
    Sample<double> expected;
    expected.add(2);
    expected.add(0.5);
    for (const char* text : {"2\n0.5\n", "id size\n1 2\n2 0.5\n", "1 2 1\n1 0.5 1"})
        EXPECT_EQ(read_diameters(text, "f"), expected) << text;
    EXPECT_EQ(refusal("0\n", false), "f, line 1: a diameter must be greater than 0, not 0");
    EXPECT_EQ(refusal("1e13\n", false), "f, line 1: a diameter must be at most 1e+12, not 1e+13");
    EXPECT_EQ(refusal("1 2 3 4\n", false), "f, line 1: 4 words where a size has 1 to 3 numbers");
}
