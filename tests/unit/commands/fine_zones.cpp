#include "commands/stability/fine_zones.hpp"

#include <gtest/gtest.h>

namespace kaya {
namespace {

FailureMode::Shares with_zones(double high) {
    FailureMode::Shares mode;
    mode.zones_high = high;
    return mode;
}

TEST(FineZones, TheFactorLiesBelowThatOfSharedStrainsByAFifthOfWhatSharingTakesAway) {
    const auto fine = fine_factor(1.2, 1.05, with_zones(5), 0);
    ASSERT_TRUE(fine);
    EXPECT_NEAR(fine->factor, 1.02, 1e-12);
    EXPECT_NEAR(fine->error, 0.045 * 1.02, 1e-12);
}

TEST(FineZones, TheBandIsNarrowerWithMoreZonesAndWiderWithACoarserBracket) {
    const double five = fine_factor(1.2, 1.05, with_zones(5), 0)->error,
                 twenty = fine_factor(1.2, 1.05, with_zones(20), 0)->error,
                 coarse = fine_factor(1.2, 1.05, with_zones(20), 0.01)->error;
    EXPECT_NEAR(five - twenty, 0.03 * 1.02, 1e-12);
    EXPECT_NEAR(coarse - twenty, 0.005 * (1.2 * 1.05 + 0.2 * 1.2),
                1e-12); // both factors are known within half of the resolution
}

TEST(FineZones, ThereIsNoFactorFromFewZonesNorWhereSharingMakesThemStronger) {
    EXPECT_FALSE(fine_factor(1.2, 1.05, with_zones(0), 0.01));
    EXPECT_FALSE(fine_factor(1.2, 1.05, with_zones(1.9), 0.01));
    EXPECT_FALSE(fine_factor(1.0, 1.02, with_zones(5), 0.01));
    EXPECT_TRUE(fine_factor(1.0, 1.005, with_zones(5), 0.01)); // equal within the resolution
}

} // namespace
} // namespace kaya
