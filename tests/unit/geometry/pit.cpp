// Walls of pits: heights compared with distances from the crest, ramps, families of the same pit, and impossible designs.
#include "geometry/ground/pit.hpp"

#include "base/diagnostic.hpp"
#include "geometry/ground/ground_cuts.hpp"
#include "geometry/surface/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace kaya {
namespace {

using testing::HasSubstr;

const std::vector<Vec3> rectangle{{0, 0, 300}, {600, 0, 300}, {600, 500, 300}, {0, 500, 300}};
const std::vector<Vec3> bent{{0, 0, 50}, {500, 0, 50}, {500, 500, 50}, {250, 500, 50}, {250, 250, 50}, {0, 250, 50}};

PitDesign four_benches() {
    PitDesign design;
    design.bench = 15, design.benches = 4, design.angle = 65, design.berm = 8;
    return design;
}

PitDesign with_ramp(bool clockwise = false) {
    PitDesign design = four_benches();
    design.ramp = PitRamp{20, 0.1, {200, -5}, clockwise};
    return design;
}

/// Depth of the wall at a distance from the crest, by counting benches.
double depth_at(const PitDesign& design, double distance) {
    const double face = design.bench / std::tan(design.angle * std::numbers::pi / 180);
    double depth = 0;
    for (int k = 0; k < design.benches; ++k) {
        depth += std::clamp(distance / face, 0.0, 1.0) * design.bench;
        distance -= face + design.berm;
    }
    return depth;
}

double plan_area(const Ground& ground) {
    double sum = 0;
    for (const auto& t : ground.triangles()) {
        const Vec3 a = ground.corners()[static_cast<std::size_t>(t[0])],
                   b = ground.corners()[static_cast<std::size_t>(t[1])] - a,
                   c = ground.corners()[static_cast<std::size_t>(t[2])] - a;
        sum += 0.5 * std::abs(b.x() * c.y() - b.y() * c.x());
    }
    return sum;
}

/// Calls visit for points within the box of an outline.
void at_places(const std::vector<Vec3>& outline, const std::function<void(double, double)>& visit) {
    Vec3 low = outline.front(), high = low;
    for (const Vec3& p : outline) low = low.cwiseMin(p), high = high.cwiseMax(p);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0.001, 0.999);
    for (int i = 0; i < 4000; ++i) {
        const double a = part(random), b = part(random);
        visit(low.x() + a * (high.x() - low.x()), low.y() + b * (high.y() - low.y()));
    }
}

std::string message_of(const std::vector<Vec3>& outline, const PitDesign& design) {
    try {
        pit_surface(outline, design);
    } catch (const Diagnostic& wrong) { return wrong.message; }
    return "";
}

TEST(Pit, HeightsFollowTheDistanceFromTheCrest) {
    const PitDesign design = four_benches();
    const Ground ground = pit_surface(rectangle, design);
    EXPECT_NEAR(plan_area(ground), 300000, 1e-3);
    at_places(rectangle, [&](double x, double y) {
        const double distance = std::min({x, y, 600 - x, 500 - y});
        ASSERT_NEAR(ground.height(x, y).value_or(NAN), 300 - depth_at(design, distance), 1e-4) << x << ' ' << y;
    });
}

TEST(Pit, ACornerThatBendsInward) {
    const PitDesign design = four_benches();
    const Ground ground = pit_surface(bent, design);
    EXPECT_NEAR(plan_area(ground), 187500, 1e-3);
    at_places(bent, [&](double x, double y) {
        if (x < 250 && y > 250) return;
        double distance = std::min({x, y, 500 - x, 500 - y});
        // Faces meet on straight lines at the re-entrant corner, too: they are not rounded.
        distance = std::min(distance, x > 250 && y > 250 ? x - 250 : x > 250 ? std::max(x - 250, 250 - y) : 250 - y);
        ASSERT_NEAR(ground.height(x, y).value_or(NAN), 50 - depth_at(design, distance), 1e-4) << x << ' ' << y;
    });
}

TEST(Pit, FromTheToeItIsTheSamePit) {
    PitDesign design = four_benches();
    const double width = 4 * 15 / std::tan(65 * std::numbers::pi / 180) + 3 * 8;
    const Ground ground = pit_surface(rectangle, design);
    std::vector<Vec3> toe;
    for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
        toe.push_back(rectangle[toe.size()] + Vec3(width * x, width * y, -60));
    design.toe = true;
    const Ground other = pit_surface(toe, design);
    EXPECT_NEAR(plan_area(other), 300000, 1e-3);
    at_places(rectangle, [&](double x, double y) {
        ASSERT_NEAR(other.height(x, y).value_or(NAN), ground.height(x, y).value_or(NAN), 1e-4) << x << ' ' << y;
    });
}

TEST(Pit, TheRampHasTheRequestedGradeAndWidth) {
    const PitDesign design = with_ramp();
    const Ground ground = pit_surface(rectangle, design);
    EXPECT_NEAR(plan_area(ground), 300000, 1e-3);
    const Ground bare = pit_surface(rectangle, four_benches());
    // It begins to descend 20 m after its start; 100 m farther it is 10 m lower, on the first face.
    const double face = 10 / std::tan(65 * std::numbers::pi / 180);
    for (const double across : {0.01, 10.0, 19.99})
        EXPECT_NEAR(ground.height(320, face + across).value_or(NAN), 290, 1e-4) << across;
    EXPECT_NEAR(ground.height(320, face - 0.5).value_or(NAN), 290 + 0.5 * std::tan(65 * std::numbers::pi / 180), 1e-4);
    EXPECT_LT(ground.height(320, face + 20.5).value_or(NAN), 290 - 1);
    // Level around the corner, and without steps: no slope is steeper than a face, except at the start, where it crosses the face.
    const double steepest = 1.5 * std::tan(65 * std::numbers::pi / 180);
    at_places(rectangle, [&](double x, double y) {
        const double z = ground.height(x, y).value_or(NAN);
        ASSERT_NEAR(ground.height(x + 0.01, y).value_or(NAN), z, 0.01 * steepest) << x << ' ' << y;
        ASSERT_NEAR(ground.height(x, y + 0.01).value_or(NAN), z, 0.01 * steepest) << x << ' ' << y;
        ASSERT_GE(z, bare.height(x, y).value_or(NAN) - 1e-4) << "a ramp moves the wall inward";
    });
    // Before its start the wall is unchanged.
    EXPECT_NEAR(ground.height(190, 30).value_or(NAN), bare.height(190, 30).value_or(NAN), 1e-6);
}

TEST(Pit, TheSamePitTurnedMirroredFarAwayAndInMillimetres) {
    const Ground ground = pit_surface(rectangle, with_ramp());
    const double c = std::cos(0.6), s = std::sin(0.6);
    struct Family {
        const char* name;
        std::function<Vec3(const Vec3&)> place;
        double unit;
        bool mirrored;
    };
    for (const Family& family :
         {Family{"turned", [&](const Vec3& p) { return Vec3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()); }, 1,
                 false},
          Family{"mirrored", [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); }, 1, true},
          Family{"far away", [](const Vec3& p) { return Vec3(p.x() + 4.5e5, p.y() + 4.2e6, p.z()); }, 1, false},
          Family{"in millimetres", [](const Vec3& p) { return Vec3(1000 * p); }, 1000, false}}) {
        PitDesign design = with_ramp(family.mirrored);
        design.bench *= family.unit, design.berm *= family.unit, design.ramp->width *= family.unit;
        const Vec3 from = family.place({design.ramp->from[0], design.ramp->from[1], 0});
        design.ramp->from = {from.x(), from.y()};
        std::vector<Vec3> outline;
        for (const Vec3& p : rectangle) outline.push_back(family.place(p));
        const Ground other = pit_surface(outline, design);
        at_places(rectangle, [&](double x, double y) {
            const Vec3 q = family.place({x, y, 0});
            ASSERT_NEAR(other.height(q.x(), q.y()).value_or(NAN) / family.unit, ground.height(x, y).value_or(NAN), 1e-4)
                << family.name << ": " << x << ' ' << y;
        });
        // The order of the corners does not matter.
        std::ranges::reverse(outline);
        const Ground reversed = pit_surface(outline, design);
        EXPECT_NEAR(plan_area(reversed), plan_area(other), 1e-6 * plan_area(other)) << family.name;
    }
}

TEST(Pit, CutsABrickWithoutGapsAndOverlaps) {
    const Ground ground = pit_surface(rectangle, with_ramp());
    const Polyhedron brick = make_brick({-100, -100, 150}, {700, 600, 300});
    const SidedBlocks cut = cut_by_ground({brick}, ground, 3, 1e-3);
    double all = 0, above = 0, expected = 0;
    for (std::size_t i = 0; i < cut.blocks.pieces.size(); ++i) {
        const double volume = mass_properties(cut.blocks.pieces[i].polyhedron).volume;
        all += volume;
        if (!cut.inside[i]) above += volume;
    }
    for (const auto& t : ground.triangles()) {
        const auto corner = [&](std::size_t k) { return ground.corners()[static_cast<std::size_t>(t[k])]; };
        const Vec3 b = corner(1) - corner(0), d = corner(2) - corner(0);
        expected +=
            0.5 * std::abs(b.x() * d.y() - b.y() * d.x()) * (300 - (corner(0).z() + corner(1).z() + corner(2).z()) / 3);
    }
    EXPECT_NEAR(all, 800.0 * 700 * 150, 1);
    EXPECT_NEAR(above, expected, 1e-6 * expected);
}

TEST(Pit, DesignsThatCannotBe) {
    EXPECT_THAT(message_of({{0, 0, 0}, {1, 0, 0}}, four_benches()), HasSubstr("three corners"));
    EXPECT_THAT(message_of({{0, 0, 0}, {100, 100, 0}, {100, 0, 0}, {0, 100, 0}}, four_benches()), HasSubstr("crosses"));
    EXPECT_THAT(message_of({{0, 0, 0}, {100, 0, 5}, {100, 100, 0}}, four_benches()), HasSubstr("must be level"));
    EXPECT_THAT(message_of({{0, 0, 0}, {0, 0, 0}, {100, 0, 0}, {100, 100, 0}}, four_benches()),
                HasSubstr("are the same"));
    EXPECT_THAT(message_of({{0, 0, 0}, {90, 0, 0}, {90, 90, 0}, {0, 90, 0}}, four_benches()),
                HasSubstr("meet above the floor"));
    PitDesign design = with_ramp();
    design.ramp->gradient = 0.02;
    EXPECT_THAT(message_of(rectangle, design), HasSubstr("too long for the wall"));
    design = with_ramp();
    design.ramp->from = {20, 0};
    EXPECT_THAT(message_of(rectangle, design), HasSubstr("cannot begin here"));
    design = four_benches();
    design.toe = true;
    // A notch of 20 m vanishes in the outward construction.
    EXPECT_THAT(message_of({{0, 0, 0},
                            {300, 0, 0},
                            {300, 300, 0},
                            {160, 300, 0},
                            {160, 250, 0},
                            {140, 250, 0},
                            {140, 300, 0},
                            {0, 300, 0}},
                           design),
                HasSubstr("vanishes"));
}

std::string message_of_text(std::string_view text) {
    try {
        ground_from_pit(text, "a.pit");
    } catch (const Diagnostic& wrong) { return wrong.message; }
    return "";
}

TEST(Pit, WallsThatEndInANeedleAreRefused) {
    // A corner without a blank between two numbers lies 5,000 km away.
    EXPECT_THAT(
        message_of_text("bench 22\nbenches 4\nangle 30\nberm 8\nramp 20 0.1 from 201 0 clockwise\ntoe\n025 100 240\n"
                        "500 100 240\n5001000 2 240\n500 400 240\n100 400 240\n"),
        HasSubstr("too narrow beside the pit"));
}

TEST(Pit, FilesThatAreWrongNameTheLine) {
    const std::string outline = "crest\n0 0 300\n600 0 300\n600 500 300\n0 500 300\n0 0 300\n";
    const Ground ground = ground_from_pit(
        "# a pit\nbench 15\nbenches 4 # four\nANGLE 65\nberm 8\nramp 20 0.1 from 200 -5\n" + outline, "a.pit");
    EXPECT_NEAR(ground.height(320, 15).value_or(NAN), pit_surface(rectangle, with_ramp()).height(320, 15).value_or(0),
                1e-9);
    EXPECT_EQ(message_of_text("bench 15\n" + outline), "a.pit: a pit needs the angle of its faces");
    EXPECT_EQ(message_of_text("angle 65\n" + outline), "a.pit: a pit needs the height of its benches");
    EXPECT_EQ(message_of_text("bench 15\nbnech 2"), "a.pit:2: 'bnech' is not a word of a pit");
    EXPECT_EQ(message_of_text("bench tall"), "a.pit:1: 'tall' is not a number");
    EXPECT_EQ(message_of_text("bench 15\nberm -1"), "a.pit:2: berm must be greater than 0, not -1");
    EXPECT_EQ(message_of_text("bench 15 15"), "a.pit:1: 2 words after 'bench', and there must be 1");
    EXPECT_EQ(message_of_text("angle 90"), "a.pit:1: angle must be less than 90, not 90");
    EXPECT_EQ(message_of_text("benches 2.5"), "a.pit:1: benches must be a whole number up to 200, not 2.5");
    EXPECT_EQ(message_of_text("ramp 20 0.1"), "a.pit:1: a ramp needs its width, its gradient and where it begins");
    EXPECT_EQ(message_of_text("0 0 300"), "a.pit:1: a point stands before the word crest or toe");
    EXPECT_EQ(message_of_text("crest\n0 0"), "a.pit:2: a corner of the outline is three numbers: x y z");
    EXPECT_THAT(message_of_text("bench 15\nangle 65\ncrest\n0 0 0\n"),
                HasSubstr("a.pit: the outline of a pit needs three corners"));
}

} // namespace
} // namespace kaya
