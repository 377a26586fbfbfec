// Drawings as bytes, the frame of a picture, round numbers, curves as SVG.
#include "scene/framing.hpp"
#include "scene/svg_chart.hpp"
#include "scene/ticks.hpp"
#include "scene/wire.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace kaya {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Scene small_scene() {
    Scene scene;
    scene.title = "slope";
    scene.dip = 30;
    scene.bars.push_back({"state", 0, 1, 0, 1, false, {"elastic", "slip-now"}, ""});
    Layer layer;
    layer.points = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    layer.values = {0, 1, 1};
    layer.bar = 0;
    scene.layers.push_back(layer);
    return scene;
}

TEST(Wire, DrawingsAreReadUnchanged) {
    const auto scene = drawing_from(to_bytes(small_scene()));
    ASSERT_TRUE(scene && std::holds_alternative<Scene>(*scene));
    EXPECT_EQ(std::get<Scene>(*scene).bars.at(0).names.at(1), "slip-now");
    EXPECT_EQ(std::get<Scene>(*scene).layers.at(0).points.at(7), 1);
    EXPECT_EQ(to_bytes(*scene), to_bytes(small_scene()));
    const auto chart = drawing_from(to_bytes(Chart{"t", "x", "y", 100, 80, {{"c", {0, 1}, {2, 3}}}}));
    ASSERT_TRUE(chart && std::holds_alternative<Chart>(*chart));
    EXPECT_THAT(std::get<Chart>(*chart).curves.at(0).y, ElementsAre(2, 3));
}

TEST(Wire, TwoPicturesSideBySideShareTheirColours) {
    Scene before = small_scene(), after = small_scene();
    before.bars.push_back({"displacement", 0, 1, 0, 1, false, {}, ""});
    after.bars.push_back({"displacement", -2, 0.5, -2, 0.5, true, {}, ""});
    after.bars.push_back({"velocity", 3, 4, 3, 4, false, {}, ""});
    after.width = 800, after.height = 600, after.paper.dpi = 300;
    const auto read = drawing_from(to_bytes(side_by_side(before, after)));
    ASSERT_TRUE(read && std::holds_alternative<ScenePair>(*read));
    const auto& pair = std::get<ScenePair>(*read);
    EXPECT_EQ(pair.width, 1600);
    EXPECT_EQ(pair.height, 600);
    EXPECT_EQ(pair.paper.dpi, 300);
    EXPECT_EQ(pair.left.width, 800);
    for (const Scene* scene : {&pair.left, &pair.right}) {
        const ColourBar& bar = scene->bars.at(1);
        EXPECT_EQ(bar.low, -2);
        EXPECT_EQ(bar.high, 1);
        EXPECT_TRUE(bar.diverging);
        EXPECT_EQ(scene->bars.at(0).names.size(), 2); // names are not numbers
    }
    EXPECT_EQ(pair.left.bars.at(1).greatest, 1); // its own values
    EXPECT_EQ(pair.right.bars.at(1).greatest, 0.5);
    EXPECT_EQ(pair.right.bars.at(2).low, 3);
    const std::string bytes = to_bytes(*read);
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(drawing_from(bytes.substr(0, size))) << size;
}

TEST(Wire, BytesThatAreCutOffOrTooLongAreRefused) {
    const std::string bytes = to_bytes(small_scene());
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(drawing_from(bytes.substr(0, size))) << size;
    EXPECT_FALSE(drawing_from(bytes + "x"));
    std::string huge = bytes;
    huge[1] = huge[8] = '\x7f'; // the length of the title
    EXPECT_FALSE(drawing_from(huge));
}

/// Where a point is seen, in pixels from the middle of the area.
std::array<double, 2> seen(const Scene& scene, const Framing& f, const Layer& layer, std::size_t at) {
    double across = 0, upwards = 0, nearer = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double way = layer.points[at + k] - f.focus[k];
        across += way * f.right[k], upwards += way * f.up[k], nearer += way * f.toward[k];
    }
    const double pixel = scene.perspective ? f.pixel * (f.distance - nearer) / f.distance : f.pixel;
    return {across / pixel, upwards / pixel};
}

TEST(Framing, FillsItsAreaFromAnySide) {
    std::mt19937 random(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int trial = 0; trial < 200; ++trial) {
        Scene scene;
        scene.perspective = trial % 2 == 0;
        scene.dip = between(0, 180), scene.dip_direction = between(-360, 360);
        const double size = std::pow(10, between(-3, 4)), far = between(-10, 10) * size;
        Layer layer;
        for (int k = 0; k < 60; ++k)
            layer.points.push_back(static_cast<float>(far + size * between(0, 1) * (k % 3 + 1)));
        scene.layers.push_back(layer);
        const Area area{between(0, 100), between(0, 100), between(600, 1200), between(500, 900)};
        const Framing framing = framing_of(scene, area);
        double wide = 0, high = 0;
        for (std::size_t at = 0; at < layer.points.size(); at += 3) {
            const auto [x, y] = seen(scene, framing, layer, at);
            wide = std::max(wide, 2 * std::abs(x) / (area.right - area.left));
            high = std::max(high, 2 * std::abs(y) / (area.top - area.bottom));
        }
        EXPECT_LT(std::max(wide, high), 1 + 1e-6) << trial;
        EXPECT_GT(std::max(wide, high), 1 - 1e-6) << trial;
    }
}

TEST(Framing, NothingOrOnePointIsInTheMiddle) {
    for (const bool perspective : {false, true})
        for (const std::vector<float>& points : {std::vector<float>{}, {3, 4, 5}, {NAN, 0, 0}}) {
            Scene scene;
            scene.perspective = perspective;
            scene.layers.emplace_back().points = points;
            const Framing framing = framing_of(scene, {0, 0, 100, 100});
            EXPECT_GT(framing.distance, 0);
            EXPECT_GT(framing.pixel, 0);
            EXPECT_NEAR(framing.focus[2], points.size() == 3 && points[0] == 3 ? 5 : 0, 1e-6);
        }
}

TEST(Framing, ACentreAndAMagnificationOfTheUserApply) {
    Scene scene = small_scene();
    const Framing whole = framing_of(scene, {0, 0, 1000, 800});
    scene.has_centre = true, scene.centre = {1, 2, 3}, scene.magnification = 4;
    const Framing part = framing_of(scene, {0, 0, 1000, 800});
    EXPECT_EQ(part.focus[1], 2);
    EXPECT_NEAR(part.distance, whole.distance / 4, 1e-12);
    EXPECT_NEAR(part.pixel, whole.pixel / 4, 1e-12);
}

TEST(Numbers, AreShortAndLengthsRound) {
    EXPECT_EQ(short_number(0.00641312), "0.006413");
    EXPECT_EQ(short_number(-1.25e6), "-1.25e6");
    EXPECT_EQ(short_number(3e-7), "3e-7");
    EXPECT_EQ(short_number(-0.0), "0");
    for (const auto& [most, round] : {std::pair{9.9, 5.0}, {5.0, 5.0}, {4.9, 2.0}, {1.0, 1.0}, {0.019, 0.01}})
        EXPECT_NEAR(round_length(most), round, 1e-12) << most;
}

TEST(Ticks, OfEqualAxesCoverTheDataWithOneScale) {
    for (const auto& [wide, high] : {std::pair{12.0, 6.0}, {1.0, 500.0}, {500.0, 1.0}, {1e-6, 3e-6}}) {
        Ticks x = round_ticks(-wide, wide), y = round_ticks(0, high);
        const Ticks before_x = x, before_y = y;
        make_equal(x, y, 1000, 600);
        EXPECT_NEAR((x.high - x.low) / 1000, (y.high - y.low) / 600, 1e-12 * (x.high - x.low));
        EXPECT_LE(x.low, before_x.low + 1e-9 * wide);
        EXPECT_GE(y.high, before_y.high - 1e-9 * high);
        for (const Ticks& ticks : {x, y}) {
            EXPECT_THAT(ticks.values().size(), testing::AllOf(testing::Ge(2u), testing::Le(14u)));
            EXPECT_GE(ticks.values().front(), ticks.low - 1e-9 * ticks.step);
            EXPECT_LE(ticks.values().back(), ticks.high + 1e-9 * ticks.step);
        }
    }
}

TEST(Ticks, AreRoundAndEncloseTheRange) {
    EXPECT_THAT(round_ticks(0, 0.0103).values().size(), testing::AllOf(testing::Ge(3u), testing::Le(8u)));
    EXPECT_DOUBLE_EQ(round_ticks(-0.3, 9.7).low, -2);
    EXPECT_DOUBLE_EQ(round_ticks(-0.3, 9.7).high, 10);
    EXPECT_DOUBLE_EQ(round_ticks(1, 9, 5).step, 2);
    EXPECT_EQ(round_ticks(0, 0.01).label(0.004), "0.004");
    EXPECT_EQ(round_ticks(-4e6, 0).label(-2e6), "-2e6");
    EXPECT_EQ(round_ticks(-1, 1).label(-1e-17), "0.0");
    for (const auto& [low, high] : {std::pair{5.0, 5.0}, {0.0, 0.0}, {1.0, 1.0 + 1e-15}, {std::nan(""), 1.0}}) {
        const Ticks ticks = round_ticks(low, high);
        EXPECT_LT(ticks.low, ticks.high);
        EXPECT_LE(ticks.values().size(), 12u);
    }
}

TEST(Colours, LightnessOfTheSequentialMapRises) {
    double before = -1;
    for (int k = 0; k <= 20; ++k) {
        const Colour c = sequential_colour(k / 20.0);
        const double lightness =
            0.2126 * std::pow(c[0], 2.2) + 0.7152 * std::pow(c[1], 2.2) + 0.0722 * std::pow(c[2], 2.2);
        EXPECT_GT(lightness, before);
        before = lightness;
    }
}

TEST(SvgChart, ANetIsACircleWithItsWindsAndPoints) {
    Chart chart{"poles", "", "", 800, 600, {{"set 1", {0, 0.5}, {0, -0.5}, true}}, true};
    const std::string svg = svg_of(chart);
    for (const char* wind : {">N<", ">E<", ">S<", ">W<"}) EXPECT_THAT(svg, HasSubstr(wind));
    std::size_t circles = 0;
    for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++circles;
    EXPECT_EQ(circles, 4U); // the net, two points, one in the legend
}

TEST(SvgChart, DrawsCurvesWithGapsAndEscapesWords) {
    const double gap = std::nan("");
    const std::string svg =
        svg_of({"a < b & c", "time", "force", 700, 500, {{"one", {0, 1, 2, 3, 4}, {0, 1, gap, 1, 0}}}});
    EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    const auto path = svg.find("stroke-linejoin");
    ASSERT_NE(path, std::string::npos);
    const auto first = svg.rfind("d=\"", path), end = svg.find('"', first + 3);
    EXPECT_EQ(std::count(svg.begin() + static_cast<std::ptrdiff_t>(first),
                         svg.begin() + static_cast<std::ptrdiff_t>(end), 'M'),
              2)
        << "a gap begins a new line";
}

} // namespace
} // namespace kaya
