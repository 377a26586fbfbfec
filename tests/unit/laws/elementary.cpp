#include "kaya/law/elementary.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya::joints {
namespace {

TEST(Elementary, LogarithmAgreesWithTheLibrary) {
    for (double exponent = -290; exponent <= 290; exponent += 0.37) {
        const double x = std::pow(10, exponent);
        EXPECT_NEAR(logarithm(x), std::log(x), 1e-15 * std::abs(std::log(x)) + 1e-18) << x;
    }
    for (double x = 0.5; x < 2; x += 1e-3) EXPECT_NEAR(logarithm(x), std::log(x), 1e-15 * std::abs(std::log(x))) << x;
    EXPECT_EQ(logarithm(1), 0);
}

TEST(Elementary, ExponentialAgreesWithTheLibrary) {
    for (double x = -700; x <= 700; x += 0.13) EXPECT_NEAR(exponential(x) / std::exp(x), 1, 1e-15) << x;
    EXPECT_EQ(exponential(0), 1);
}

TEST(Elementary, PowerAgreesWithTheLibrary) {
    for (double x = 1e-6; x < 1e6; x *= 1.7)
        for (double y = -4; y <= 4; y += 0.4) EXPECT_NEAR(power(x, y) / std::pow(x, y), 1, 2e-14) << x << " " << y;
}

TEST(Elementary, TangentAgreesWithTheLibrary) {
    const double degree = std::numbers::pi / 180;
    for (double angle = -70; angle <= 70; angle += 0.01)
        EXPECT_NEAR(tangent_of_degrees(angle), std::tan(angle * degree),
                    1e-15 * std::abs(std::tan(angle * degree)) + 1e-18);
    EXPECT_NEAR(tangent_of_degrees(89) / std::tan(89 * degree), 1, 3e-14);
    EXPECT_NEAR(tangent_of_degrees(-89) / std::tan(-89 * degree), 1, 3e-14);
}

TEST(Elementary, ArctangentAgreesWithTheLibrary) {
    const double degrees = 180 / std::numbers::pi;
    for (double x = 1e-12; x < 1e12; x *= 1.003)
        EXPECT_NEAR(arctangent_in_degrees(x) / (std::atan(x) * degrees), 1, 1e-15) << x;
    EXPECT_EQ(arctangent_in_degrees(0), 0);
    EXPECT_EQ(arctangent_in_degrees(INFINITY), 90);
}

} // namespace
} // namespace kaya::joints
