#include "study/distribution.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya {
namespace {

/// The mean and deviation of many quantiles, evenly spaced in probability.
std::pair<double, double> moments(const Distribution& d) {
    constexpr int count = 200000;
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
