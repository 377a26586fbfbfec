#include "study/distribution.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace kaya {
namespace {

/// The mean and deviation of many quantiles, evenly spaced in probability.
std::pair<double, double> moments(const Distribution& d, int count = 200000) {
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double value = d.quantile((i + 0.5) / count);
        sum += value, squares += value * value;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(squares / count - mean * mean)};
}

class Distributions : public testing::TestWithParam<Distribution> {};

TEST_P(Distributions, QuantilesHaveTheirMeanAndDeviation) {
    const Distribution& d = GetParam();
    ASSERT_EQ(d.mistake(), "");
    const auto [mean, deviation] = moments(d);
    EXPECT_NEAR(mean, d.mean(), 1e-3 * d.deviation());
    EXPECT_NEAR(deviation, d.deviation(), 3e-3 * d.deviation());
}

Distribution made(Distribution::Kind kind, double a, double b, double mode = 0, double alpha = 1, double beta = 1) {
    Distribution d;
    d.kind = kind, d.a = a, d.b = b, d.mode = mode, d.alpha = alpha, d.beta = beta;
    return d;
}

using Kind = Distribution::Kind;
INSTANTIATE_TEST_SUITE_P(Kinds, Distributions,
                         testing::Values(made(Kind::normal, 30, 3), made(Kind::lognormal, 2e4, 8e3),
                                         made(Kind::uniform, -2, 5), made(Kind::triangular, 1, 4, 1.5),
                                         made(Kind::exponential, 7, 0), made(Kind::weibull, 1.5, 3),
                                         made(Kind::gamma, 12, 5), made(Kind::beta, 10, 20, 0, 2, 5)));

TEST(Distribution, MeanAndDeviationAreThoseThatWereGiven) {
    for (const Kind kind : {Kind::normal, Kind::lognormal, Kind::gamma}) {
        const auto d = made(kind, 12, 5);
        EXPECT_NEAR(d.mean(), 12, 1e-9);
        EXPECT_NEAR(d.deviation(), 5, 1e-9);
    }
}

/// Each kind between some of its quantiles.
TEST_P(Distributions, LimitsChangeMeanAndDeviation) {
    const double none = std::numeric_limits<double>::infinity();
    for (const auto& [low, high] : {std::pair{0.1, 0.7}, {0.6, 0.95}, {0.0, 0.3}, {0.8, 1.0}, {0.02, 0.98}}) {
        Distribution d = GetParam();
        const double least = low > 0 ? d.quantile(low) : -none, most = high < 1 ? d.quantile(high) : none;
        d.least = least, d.most = most;
        ASSERT_EQ(d.mistake(), "");
        const auto [mean, deviation] = moments(d, 30000);
        const double accuracy = std::isfinite(least) && std::isfinite(most) ? 1e-6 : 1e-3;
        EXPECT_NEAR(d.mean(), mean, accuracy * deviation) << low << ' ' << high;
        EXPECT_NEAR(d.deviation(), deviation, 3 * accuracy * deviation) << low << ' ' << high;
        EXPECT_LE(d.deviation(), GetParam().deviation() * (1 + 1e-9)); // an exponential tail has the same
    }
}

/// Boost finds no quantile of 1e-9 and of some larger parts of these.
TEST(Distribution, BetaNumbersNearAnEnd) {
    for (const auto& [alpha, beta] : {std::pair{2.0, 5.0}, {0.5, 3.0}, {3.0, 0.3}, {0.02, 3.0}}) {
        auto d = made(Kind::beta, 0, 1, 0, alpha, beta);
        d.most = d.quantile(0.3);
        EXPECT_EQ(d.mistake(), "") << alpha << ' ' << beta;
        double before = 0;
        for (int k = 1; k < 300; ++k) {
            const double value = d.quantile(std::exp(-0.2 * (300 - k)));
            EXPECT_GE(value, before - 1e-12);
            before = value;
        }
        EXPECT_LE(before, d.most);
    }
}

TEST(Distribution, LimitsOutsideOfItChangeNothing) {
    for (Distribution d : {made(Kind::uniform, -2, 5), made(Kind::beta, 10, 20, 0, 2, 5), made(Kind::normal, 30, 3)}) {
        const double mean = d.mean(), deviation = d.deviation();
        d.least = -1e3, d.most = 1e3;
        EXPECT_EQ(d.mean(), mean);
        EXPECT_EQ(d.deviation(), deviation);
    }
}

TEST(Distribution, MomentsBetweenLimitsAreThoseOfTheClosedForms) {
    // Normal numbers above a limit: the mean rises by deviation times the hazard.
    for (const double least : {-3.0, 0.0, 1.0, 6.0, 10.0}) {
        auto d = made(Kind::normal, 1, 2);
        d.least = least;
        const double a = 0.5 * (least - 1);
        const double hazard =
            std::exp(-0.5 * a * a) / std::sqrt(2 * std::numbers::pi) / (0.5 * std::erfc(a / std::sqrt(2)));
        EXPECT_NEAR(d.mean() / (1 + 2 * hazard), 1, 1e-8) << least;
        EXPECT_NEAR(d.deviation() / (2 * std::sqrt(1 + a * hazard - hazard * hazard)), 1, 1e-6) << least;
        // The mirror image.
        auto mirrored = made(Kind::normal, -1, 2);
        mirrored.most = -least;
        EXPECT_NEAR(mirrored.mean() / d.mean(), -1, 1e-8);
        EXPECT_NEAR(mirrored.deviation() / d.deviation(), 1, 1e-8);
    }
    for (const double most : {0.01, 0.3, 1.5, 20.0}) {
        auto d = made(Kind::exponential, 1, 0);
        d.most = most;
        const double left = std::exp(-most), inside = -std::expm1(-most);
        const double mean = 1 - most * left / inside;
        EXPECT_NEAR(d.mean() / mean, 1, 1e-8) << most;
        EXPECT_NEAR(d.deviation() / std::sqrt(1 - most * most * left / (inside * inside)), 1, 1e-6) << most;
        d.most = std::numeric_limits<double>::infinity(), d.least = most; // it has no memory
        EXPECT_NEAR(d.mean() / (1 + most), 1, 1e-8);
        EXPECT_NEAR(d.deviation(), 1, 1e-6);
    }
    // A long tail: the part of the mean of lognormal numbers above a limit.
    auto d = made(Kind::lognormal, 1, 3);
    d.least = 2;
    const double s = std::sqrt(std::log(10.0)), z = (std::log(2.0) + 0.5 * s * s) / s;
    EXPECT_NEAR(d.mean() / (normal_part(s - z) / normal_part(-z)), 1, 1e-8);
    const double square = 10 * normal_part(2 * s - z) / normal_part(-z);
    EXPECT_NEAR(d.deviation() / std::sqrt(square - d.mean() * d.mean()), 1, 1e-6);
}

TEST(Distribution, ACutKeepsNumbersInsideAndTheirOrder) {
    auto d = made(Kind::normal, 0, 1);
    d.least = 0.5, d.most = 1;
    double before = 0.5;
    for (int i = 1; i < 100; ++i) {
        const double value = d.quantile(i / 100.0);
        EXPECT_GE(value, before);
        EXPECT_LE(value, 1);
        before = value;
    }
    // Half of the probability between: Phi(x) = (Phi(0.5) + Phi(1)) / 2.
    EXPECT_NEAR(d.quantile(0.5), normal_quantile(0.5 * (normal_part(0.5) + normal_part(1))), 1e-12);
}

TEST(Distribution, SaysWhatIsWrongWithIt) {
    EXPECT_NE(made(Kind::normal, 0, 0).mistake(), "");
    EXPECT_NE(made(Kind::lognormal, -1, 1).mistake(), "");
    EXPECT_NE(made(Kind::uniform, 2, 2).mistake(), "");
    EXPECT_NE(made(Kind::triangular, 0, 1, 2).mistake(), "");
    EXPECT_NE(made(Kind::beta, 0, 1, 0, 0, 1).mistake(), "");
    EXPECT_NE(made(Kind::normal, std::nan(""), 1).mistake(), "");
    auto far = made(Kind::normal, 0, 1);
    far.least = 50;
    EXPECT_NE(far.mistake(), "");
}

} // namespace
} // namespace kaya
