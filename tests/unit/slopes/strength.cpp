#include "slopes/strength.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace kaya {
namespace {

constexpr double radian = std::numbers::pi / 180;

/// The tangent is on the envelope with its slope, by differences.
void expect_touching(const Strength& strength, double stress) {
    const Coulomb line = strength.tangent(stress);
    const double h = 1e-5 * stress;
    const auto envelope = [&](double n) { return strength.tangent(n).at(n); };
    EXPECT_NEAR(line.tan_friction, (envelope(stress + h) - envelope(stress - h)) / (2 * h), 1e-6);
}

TEST(Strength, CoulombIsItsOwnTangent) {
    const Strength strength = Strength::coulomb(5e3, 30);
    EXPECT_TRUE(strength.fails());
    EXPECT_TRUE(strength.is_linear());
    EXPECT_NEAR(strength.tangent(1e5).at(1e5), 5e3 + 1e5 * std::tan(30 * radian), 1e-6);
    EXPECT_FALSE(Strength().fails());
}

TEST(Strength, BartonIsTheFormulaAndItsSlope) {
    const Strength strength = Strength::barton({.residual_friction = 25, .jrc = 8, .jcs = 100e6});
    for (const double n : {1e4, 3e5, 1e6, 2e7, 9e7}) {
        const double angle = std::min(70.0, 25 + 8 * std::log10(100e6 / n));
        EXPECT_NEAR(strength.tangent(n).at(n), n * std::tan(angle * radian), 1e-9 * n);
        expect_touching(strength, n);
    }
    EXPECT_NEAR(strength.tangent(2e8).at(2e8), 2e8 * std::tan(25 * radian), 1)
        << "beyond JCS only the residual angle is left";
    EXPECT_EQ(strength.tangent(0).cohesion, 0);
    EXPECT_NEAR(strength.tangent(-1e5).tan_friction, std::tan(70 * radian), 1e-12);
}

TEST(Strength, HoekBrownTouchesItsCirclesOfMohr) {
    const Strength strength = Strength::hoek_brown({.strength = 30e6, .mb = 0.067, .s = 2.5e-5, .a = 0.619});
    for (const double minor : {0.0, 2e4, 1e5, 1e6}) {
        const double major = minor + 30e6 * std::pow(0.067 * minor / 30e6 + 2.5e-5, 0.619);
        const double centre = 0.5 * (major + minor), radius = 0.5 * (major - minor);
        // No part of the circle is above the envelope, and one point is on it.
        double nearest = INFINITY;
        for (int k = 1; k < 2000; ++k) {
            const double angle = k * std::numbers::pi / 2000, n = centre + radius * std::cos(angle);
            nearest = std::min(nearest, (strength.tangent(n).at(n) - radius * std::sin(angle)) / radius);
        }
        EXPECT_NEAR(nearest, 0, 1e-5) << minor;
        expect_touching(strength, centre);
    }
}

} // namespace
} // namespace kaya
