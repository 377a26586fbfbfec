// The rows of solve control around its peak.
#include "commands/stability/load_curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace kaya {
namespace {

constexpr int cycles_of_row = 50, cycles_of_part = 10;
constexpr double step = 0.004; ///< of the displacement, in a cycle

using Load = std::function<double(double displacement)>;

/// Means of some cycles; a row is at rest where the load has no jump.
CurveRow mean(const Load& load, int first, int count) {
    CurveRow row;
    row.at_rest = true;
    for (int cycle = first; cycle < first + count; ++cycle) {
        const double at = cycle * step;
        row.displacement += at / count;
        row.load += load(at) / count;
        row.at_rest = row.at_rest && load(at) - load(at + step) < 0.1;
    }
    row.pushed = row.load;
    return row;
}

LoadCurve curve_of(const Load& load, int rows, bool parts_rest = true) {
    LoadCurve curve;
    for (int k = 0; k < rows; ++k) {
        std::vector<CurveRow> parts;
        for (int from = k * cycles_of_row; from < (k + 1) * cycles_of_row; from += cycles_of_part) {
            parts.push_back(mean(load, from, cycles_of_part));
            parts.back().at_rest = parts.back().at_rest && parts_rest;
        }
        curve.add(mean(load, k * cycles_of_row, cycles_of_row), std::move(parts));
    }
    return curve;
}

/// Rises evenly to 1 at a displacement of `at`, and falls to a fifth.
Load sharp(double at) {
    return [at](double u) { return u <= at ? u / at : 0.2; };
}

} // namespace

TEST(LoadCurve, DividesRowsAroundASharpPeak) {
    for (const double at : {1.0, 1.07, 1.13, 1.19}) {
        const LoadCurve curve = curve_of(sharp(at), 10);
        EXPECT_GT(curve.peak().load, 1 - 1.5 * cycles_of_part * step / at) << at;
        EXPECT_LE(curve.peak().load, 1) << at;
        EXPECT_TRUE(curve.peak_is_at_rest());
        EXPECT_GT(curve.size(), 20u);
        EXPECT_LE(curve.size(), 38u) << "rows far from the peak stay whole";
        // The true peak lies within the remaining doubt.
        EXPECT_GE(curve.peak().load * (1 + curve.doubt_of_peak()), 1) << at;
        LoadCurve whole;
        for (int k = 0; k < 10; ++k) whole.add(mean(sharp(at), k * cycles_of_row, cycles_of_row), {});
        EXPECT_LT(whole.peak().load, curve.peak().load) << at;
        EXPECT_LT(curve.doubt_of_peak(), 0.5 * whole.doubt_of_peak()) << at;
    }
}

TEST(LoadCurve, DividesTheFirstRow) {
    const LoadCurve curve = curve_of(sharp(0.2), 4);
    EXPECT_GT(curve.peak().load, 1 - cycles_of_part * step / 0.2);
}

TEST(LoadCurve, LeavesFlatPeaksAndRisingLoads) {
    EXPECT_EQ(curve_of([](double u) { return u; }, 10).size(), 10u);
    EXPECT_EQ(curve_of([](double u) { return 1 - 0.05 * (u - 1) * (u - 1); }, 10).size(), 10u);
    EXPECT_EQ(curve_of([](double) { return 0.5; }, 10).size(), 10u);
}

TEST(LoadCurve, CountsSwingsNearThePeak) {
    // Waves on a plateau, that decay or not, with the highest first or last.
    const auto wave = [](double height, double decay, double phase) {
        return curve_of(
            [=](double u) { return std::min(u, 1.0) * (1 + height * std::exp(-decay * u) * std::sin(2 * u - phase)); },
            40);
    };
    EXPECT_EQ(wave(0.02, 0, 0).swings_at_peak(0.01), 2);
    EXPECT_EQ(wave(0.02, 0, 1).swings_at_peak(0.01), 2);
    EXPECT_EQ(wave(0.02, 0.1, 1).swings_at_peak(0.01), 2);
    EXPECT_EQ(wave(0.004, 0, 0).swings_at_peak(0.01), 0);
    // A peak, and a part that fails before the whole does.
    EXPECT_EQ(curve_of([](double u) { return 1 - 0.05 * (u - 1) * (u - 1); }, 20).swings_at_peak(0.01), 0);
    EXPECT_EQ(curve_of(sharp(1), 10).swings_at_peak(0.01), 0);
    EXPECT_LE(curve_of([](double u) { return u < 0.8 ? u : u - 0.3; }, 20).swings_at_peak(0.01), 1);
    EXPECT_EQ(LoadCurve().swings_at_peak(0.01), 0);
}

TEST(LoadCurve, LeavesRowsWhosePartsMove) {
    const LoadCurve curve = curve_of(sharp(1), 10, false);
    EXPECT_EQ(curve.size(), 10u);
    EXPECT_TRUE(curve.peak_is_at_rest());
}

TEST(LoadCurve, CountsRowsAsTheyWereAddedForTheEnd) {
    const auto rows_until_below = [](double at) {
        for (int rows = 1;; ++rows)
            if (curve_of(sharp(at), rows).stays_below(0.25)) return rows;
    };
    EXPECT_EQ(rows_until_below(0.99), 5 + 3); // the load falls at the end of the fifth row
    EXPECT_EQ(rows_until_below(1), 5 + 3);    // at the begin of the sixth
}

} // namespace kaya
