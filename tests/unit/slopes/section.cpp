#include "slopes/search.hpp"

#include "base/diagnostic.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya {
namespace {

/// 10 m high, 2 horizontal to 1 vertical, from the toe at 0; `shift` moves it.
SlopeSection slope(double shift = 0) {
    SlopeSection section;
    section.strengths = {Strength::coulomb(10e3, 20)};
    const auto cell = [&](std::initializer_list<SectionPoint> corners) {
        SectionCell c;
        for (const SectionPoint& p : corners) c.corners.push_back(p + SectionPoint(shift, 0));
        c.unit_weight = 20e3;
        section.cells.push_back(c);
    };
    cell({{-20, -10}, {-20, 0}, {0, 0}, {0, -10}});
    cell({{0, -10}, {0, 0}, {20, 10}, {20, -10}});
    cell({{20, -10}, {20, 10}, {50, 10}, {50, -10}});
    return section;
}

TEST(SlopeColumns, GroundWeightAndGaps) {
    const SlopeSection section = slope();
    const SlopeColumns columns(section);
    EXPECT_NEAR(*columns.ground_at(10), 5, 1e-12);
    EXPECT_NEAR(columns.column({10, 1}).weight, 80e3, 1e-6);
    EXPECT_NEAR(columns.column({10, 1}).moment, 160e3, 1e-6);
    EXPECT_FALSE(columns.ground_at(51));
    SlopeSection gap = section;
    gap.cells.erase(gap.cells.begin() + 1);
    EXPECT_THROW(SlopeColumns{gap}, Diagnostic);
    EXPECT_THROW(SlopeColumns{SlopeSection{}}, Diagnostic);
}

TEST(SlopeColumns, AnUprightFaceHasTwoHeights) {
    SlopeSection section;
    section.strengths = {Strength::coulomb(1, 1)};
    section.cells = {{{{-5, -5}, {-5, 0}, {0, 0}, {0, -5}}, 1, 0}, {{{0, -5}, {0, 10}, {5, 10}, {5, -5}}, 1, 0}};
    const SlopeColumns columns(section);
    EXPECT_NEAR(*columns.ground_at(0, SlopeColumns::Side::left), 0, 1e-12);
    EXPECT_NEAR(*columns.ground_at(0, SlopeColumns::Side::right), 10, 1e-12);
}

TEST(Slices, SumsAreThoseOfTheCircle) {
    const SlopeSection section = slope();
    const SlopeColumns columns(section);
    const auto surface = circle_surface(columns, {5, 25}, 25);
    ASSERT_TRUE(surface);
    const auto body = body_above(columns, *surface, 200);
    ASSERT_TRUE(body);
    double width = 0, weight = 0;
    for (const Slice& slice : body->slices) width += slice.width, weight += slice.weight;
    EXPECT_NEAR(width, surface->points.back().x() - surface->points.front().x(), 1e-9);
    double area = 0; // by another formula
    for (int k = 0; k < 20000; ++k) {
        const double x = surface->points.front().x() + width * (k + 0.5) / 20000, d = x - 5;
        area += (*columns.ground_at(x) - (25 - std::sqrt(625 - d * d))) * width / 20000;
    }
    EXPECT_NEAR(weight, 20e3 * area, 1e-4 * weight);
}

TEST(Slices, WhatCannotSlideHasNoFactor) {
    const SlopeSection section = slope();
    const SlopeColumns columns(section);
    EXPECT_FALSE(circle_surface(columns, {5, 500}, 25)) << "above the ground";
    EXPECT_FALSE(circle_surface(columns, {5, 25}, 80)) << "below the section";
    SlipSurface inside_out;
    inside_out.points = {{30, 10}, {0, 0}};
    EXPECT_FALSE(body_above(columns, inside_out, 20));
    SlipSurface above;
    above.points = {{0, 0}, {10, 9}, {25, 10}};
    EXPECT_FALSE(body_above(columns, above, 20));
    EXPECT_FALSE(factor_of_safety(SlipBody{}, SliceMethod::spencer));
    SlipSurface plane;
    plane.points = {{0, 0}, {25, 10}};
    const auto body = body_above(columns, plane, 20);
    ASSERT_TRUE(body);
    EXPECT_FALSE(factor_of_safety(*body, SliceMethod::bishop)) << "is no circle";
    EXPECT_TRUE(factor_of_safety(*body, SliceMethod::spencer));
}

/// Water up to the crest adds equal pressure on all sides: the weight of the body is reduced by buoyancy.
TEST(Slices, ASlopeUnderWaterIsOneOfBuoyantWeight) {
    SlopeSection flooded = slope(), buoyant = slope();
    flooded.pore_pressure = [](const SectionPoint& p) { return 9810 * (15 - p.y()); };
    flooded.water_is_open = true;
    for (SectionCell& cell : buoyant.cells) cell.unit_weight -= 9810;
    const SlopeColumns wet(flooded), light(buoyant);
    const auto surface = circle_surface(wet, {5, 25}, 25);
    ASSERT_TRUE(surface);
    const auto a = body_above(wet, *surface, 400), b = body_above(light, *surface, 400);
    for (const SliceMethod method :
         {SliceMethod::bishop, SliceMethod::janbu, SliceMethod::spencer, SliceMethod::morgenstern_price}) {
        const auto under = factor_of_safety(*a, method), by_weight = factor_of_safety(*b, method);
        ASSERT_TRUE(under && by_weight) << name_of(method);
        EXPECT_NEAR(under->factor, by_weight->factor, 2e-3 * by_weight->factor) << name_of(method);
    }
}

TEST(SurfaceSearch, KeepsToItsLimitsAndIsTheSameTwice) {
    const SlopeSection section = slope();
    const SlopeColumns columns(section);
    SurfaceSearch search;
    const auto free = weakest_circle(columns, search);
    ASSERT_TRUE(free);
    search.entry = {30, 35};
    search.exit = {-5, 0};
    const auto limited = weakest_circle(columns, search), again = weakest_circle(columns, search);
    ASSERT_TRUE(limited && again);
    EXPECT_EQ(limited->answer.factor, again->answer.factor);
    EXPECT_GE(limited->answer.factor, free->answer.factor - 1e-6);
    EXPECT_GE(limited->surface.points.back().x(), 30 - 1e-6);
    EXPECT_LE(limited->surface.points.front().x(), 1e-6);
    const auto polyline = weakest_polyline(columns, SurfaceSearch{});
    ASSERT_TRUE(polyline);
    EXPECT_NEAR(polyline->answer.factor, free->answer.factor, 0.02 * free->answer.factor)
        << "in one soil a circle is nearly the weakest";
}

TEST(SurfaceSearch, AWeakLayerIsFollowed) {
    SlopeSection section = slope();
    section.strengths.push_back(Strength::coulomb(0, 8));
    section.cells.clear();
    const auto cell = [&](std::vector<SectionPoint> corners, std::size_t strength) {
        section.cells.push_back({std::move(corners), 20e3, strength});
    };
    cell({{-20, -10}, {-20, -1.5}, {50, -1.5}, {50, -10}}, 0);
    cell({{-20, -1.5}, {-20, -1}, {50, -1}, {50, -1.5}}, 1);
    cell({{-20, -1}, {-20, 0}, {0, 0}, {0, -1}}, 0);
    cell({{0, -1}, {0, 0}, {20, 10}, {20, -1}}, 0);
    cell({{20, -1}, {20, 10}, {50, 10}, {50, -1}}, 0);
    const SlopeColumns columns(section);
    const auto circle = weakest_circle(columns, SurfaceSearch{}), polyline = weakest_polyline(columns, SurfaceSearch{});
    ASSERT_TRUE(circle && polyline);
    EXPECT_LT(polyline->answer.factor, 0.97 * circle->answer.factor);

    double length = 0;
    for (const auto& base : columns.bases_of_weak_layers()) {
        length += base.to.x() - base.from.x();
        EXPECT_NEAR(base.from.y(), -1.5, 1e-9);
        EXPECT_NEAR(base.to.y(), -1.5, 1e-9);
    }
    EXPECT_NEAR(length, 70, 1e-9);
    // A grid of surfaces along that base contains no weaker one.
    int count = 0;
    for (double lower = 0; lower < 10; lower += 1)
        for (double upper = lower + 2; upper < 25; upper += 1)
            for (double leg = 1; leg < 8; leg += 1)
                for (double back = 2; back < 16; back += 1) {
                    const SlipSurface along{{{lower - leg, *columns.ground_at(lower - leg)},
                                             {lower, -1.5},
                                             {upper, -1.5},
                                             {upper + back, *columns.ground_at(upper + back)}},
                                            {}};
                    const auto body = body_above(columns, along, 30);
                    const auto answer = body ? factor_of_safety(*body, SliceMethod::spencer) : std::nullopt;
                    if (!answer || answer->lambda < 0) continue;
                    ++count;
                    EXPECT_GE(answer->factor, 0.999 * polyline->answer.factor) << lower << ' ' << upper;
                }
    EXPECT_GT(count, 1000);
}

/// A weak joint that dips gently out of a slope, and a fault behind the crest.
SlopeSection on_a_weak_layer() {
    SlopeSection section = slope();
    section.strengths.push_back(Strength::coulomb(0, 8));
    section.strengths.push_back(Strength::coulomb(0, 20));
    section.strengths[0] = Strength::coulomb(60e3, 30);
    section.joints.push_back({{0, 0}, {20, 1}, 1});
    section.joints.push_back({{20, 1}, {28, 1.4}, 1}); // in two parts, as in two blocks
    section.joints.push_back({{28, 1.4}, {33, 10}, 2});
    return section;
}

TEST(WeakestPolyline, FollowsAWeakLayerAndAFault) {
    const SlopeSection section = on_a_weak_layer();
    const SlopeColumns columns(section);
    SurfaceSearch search;
    const auto found = weakest_polyline(columns, search);
    ASSERT_TRUE(found);
    const SlipSurface along{{{0, 0}, {28, 1.4}, {33, 10}}, {}};
    const auto body = body_above(columns, along, search.slices);
    ASSERT_TRUE(body);
    const auto exact = factor_of_safety(*body, SliceMethod::spencer);
    ASSERT_TRUE(exact);
    EXPECT_LE(found->answer.factor, 1.0001 * exact->factor);
    EXPECT_GT(found->answer.factor, 0.8 * exact->factor);
    // Both ends are on the ground, not at the intersection of the joints below it.
    const SectionPoint last = found->surface.points.back(), first = found->surface.points.front();
    EXPECT_NEAR(*columns.ground_at(last.x(), SlopeColumns::Side::left), last.y(), 1e-6);
    EXPECT_NEAR(*columns.ground_at(first.x()), first.y(), 1e-6);
    // Without the joints the rock alone is much stronger.
    SlopeSection sound = section;
    sound.joints.clear();
    const auto other = weakest_polyline(SlopeColumns(sound), search);
    ASSERT_TRUE(other);
    EXPECT_GT(other->answer.factor, 2 * found->answer.factor);
}

} // namespace
} // namespace kaya
