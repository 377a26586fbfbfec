#include "study/design.hpp"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace kaya {
namespace {

Factor scattering(const std::string& name, Distribution::Kind kind, double a, double b) {
    Factor factor{name, {}, Distribution{}, {}, {}};
    factor.distribution->kind = kind, factor.distribution->a = a, factor.distribution->b = b;
    return factor;
}

Study sampled(Design::Method method, std::size_t samples) {
    Study study;
    study.factors = {scattering("x", Distribution::Kind::uniform, 0, 1),
                     scattering("y", Distribution::Kind::normal, 10, 2),
                     scattering("z", Distribution::Kind::lognormal, 5, 1)};
    study.design.method = method;
    study.design.samples = samples;
    return study;
}

std::vector<double> column(const std::vector<Case>& cases, std::size_t j) {
    std::vector<double> numbers;
    for (const auto& one : cases) numbers.push_back(number_of(one.values[j].second));
    return numbers;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        mx += x[i] / static_cast<double>(x.size()), my += y[i] / static_cast<double>(y.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        xx += (x[i] - mx) * (x[i] - mx), yy += (y[i] - my) * (y[i] - my), xy += (x[i] - mx) * (y[i] - my);
    return xy / std::sqrt(xx * yy);
}

TEST(Design, AGridTakesAllCombinationsWithTheFirstSlowest) {
    Study study;
    study.factors = {
        {"a", {StudyValue(1.0), StudyValue(2.0)}, {}, {}, {}},
        {"b", {StudyValue(std::string("u")), StudyValue(std::string("v")), StudyValue(std::string("w"))}, {}, {}, {}}};
    study.fixed = {{"c", StudyValue(std::int64_t{7})}};
    const auto cases = cases_of(study);
    ASSERT_EQ(cases.size(), 6U);
    std::string all;
    for (const auto& one : cases)
        all += text_of(one.values[0].second) + text_of(one.values[1].second) + text_of(one.values[2].second) + " ";
    EXPECT_EQ(all, "1.0u7 1.0v7 1.0w7 2.0u7 2.0v7 2.0w7 ");
    EXPECT_EQ(cases.back().number, 6U);
}

TEST(Design, OneAtATimeHasTheBaseOnce) {
    Study study;
    study.design.method = Design::Method::one_at_a_time;
    study.factors = {{"a", {StudyValue(1.0), StudyValue(2.0), StudyValue(3.0)}, {}, StudyValue(2.0), {}},
                     {"b", {StudyValue(5.0)}, {}, StudyValue(4.0), {}}};
    EXPECT_EQ(cases_of(study).size(), 4U);
}

TEST(Design, ALatinHypercubeHasOneInEachStratum) {
    constexpr std::size_t samples = 97;
    for (const bool correlated : {false, true}) {
        Study study = sampled(Design::Method::latin_hypercube, samples);
        if (correlated) study.design.correlations = {{0, 1, 0.7}};
        const auto cases = cases_of(study);
        for (std::size_t j = 0; j < 3; ++j) {
            std::set<std::size_t> strata;
            for (std::size_t k = 0; k < samples; ++k) {
                const double low = study.factors[j].distribution->quantile((static_cast<double>(k) + 1e-12) / samples);
                const double high =
                    study.factors[j].distribution->quantile((static_cast<double>(k) + 1 - 1e-12) / samples);
                const auto numbers = column(cases, j);
                if (std::ranges::count_if(numbers, [&](double x) { return x >= low && x <= high; }) == 1)
                    strata.insert(k);
            }
            EXPECT_EQ(strata.size(), samples) << j;
        }
    }
}

class Correlated : public testing::TestWithParam<Design::Method> {};

TEST_P(Correlated, NumbersGoTogetherAsAsked) {
    Study study = sampled(GetParam(), 4000);
    study.factors[0] = scattering("x", Distribution::Kind::normal, 3, 1);
    study.design.correlations = {{0, 1, -0.6}, {1, 2, 0.3}};
    const auto cases = cases_of(study);
    const auto x = column(cases, 0), y = column(cases, 1), z = column(cases, 2);
    EXPECT_NEAR(correlation(x, y), -0.6, 0.03);
    EXPECT_NEAR(correlation(y, z), 0.3, 0.04);
    EXPECT_NEAR(correlation(x, z), 0, 0.04);
}
INSTANTIATE_TEST_SUITE_P(Methods, Correlated,
                         testing::Values(Design::Method::latin_hypercube, Design::Method::sobol,
                                         Design::Method::random));

TEST(Design, TheSameSeedGivesTheSameNumbersAndAnotherOthers) {
    for (const auto method : {Design::Method::latin_hypercube, Design::Method::sobol, Design::Method::random}) {
        Study study = sampled(method, 50);
        const auto one = column(cases_of(study), 1);
        EXPECT_EQ(one, column(cases_of(study), 1));
        study.design.seed = 2;
        EXPECT_NE(one, column(cases_of(study), 1));
    }
}

TEST(Design, SobolNumbersFillTheSquareMoreEvenlyThanChance) {
    Study study = sampled(Design::Method::sobol, 1024);
    study.factors = {scattering("x", Distribution::Kind::uniform, 0, 1),
                     scattering("y", Distribution::Kind::uniform, 0, 1)};
    // The mean of x y is 1/4; with random samples its error would be about 0.22 / 32 = 0.007.
    double sum = 0;
    for (const auto& one : cases_of(study))
        sum += number_of(one.values[0].second) * number_of(one.values[1].second) / 1024;
    EXPECT_NEAR(sum, 0.25, 0.001);
}

TEST(Design, APointEstimateGivesMeanAndVarianceOfALinearFunction) {
    Study study = sampled(Design::Method::point_estimate, 0);
    study.factors.pop_back();
    study.factors[0] = scattering("x", Distribution::Kind::normal, 3, 1);
    study.design.correlations = {{0, 1, 0.5}};
    double weights = 0, mean = 0, square = 0;
    for (const auto& one : cases_of(study)) {
        const double f = 2 * number_of(one.values[0].second) + number_of(one.values[1].second);
        weights += one.weight, mean += one.weight * f, square += one.weight * f * f;
    }
    EXPECT_NEAR(weights, 1, 1e-12);
    EXPECT_NEAR(mean, 16, 1e-12);
    EXPECT_NEAR(square - mean * mean, 4 * 1 + 4 + 2 * 2 * 0.5 * 1 * 2, 1e-9); // a²σx² + σy² + 2 a ρ σx σy
}

/// The message and the hint of a study that cannot be designed.
std::string refusal(const Study& study) {
    try {
        cases_of(study);
    } catch (const Diagnostic& error) { return error.message + "; " + error.hint; }
    return "";
}

TEST(Design, APointEstimateHasTheMomentsBetweenTheLimits) {
    Study study = sampled(Design::Method::point_estimate, 0);
    study.factors = {scattering("x", Distribution::Kind::normal, 1, 2),
                     scattering("y", Distribution::Kind::exponential, 1, 0)};
    study.factors[0].distribution->least = 0;
    study.factors[1].distribution->most = 1.5;
    const auto cases = cases_of(study);
    const auto x = column(cases, 0), y = column(cases, 1);
    EXPECT_NEAR(0.5 * (x[0] + x[3]), 2.0183, 1e-4); // 1 + 2 phi(0.5) / Phi(0.5)
    EXPECT_NEAR(0.5 * (x[3] - x[0]), 1.3945, 1e-4);
    EXPECT_NEAR(0.5 * (y[0] + y[3]), 0.5692, 1e-4); // 1 - 1.5 / (e^1.5 - 1)
    EXPECT_NEAR(0.5 * (y[3] - y[0]), 0.4101, 1e-4);
}

TEST(Design, APointEstimateRefusesPointsOutsideOfADistribution) {
    using Kind = Distribution::Kind;
    Study study = sampled(Design::Method::point_estimate, 0);
    for (const auto& wide : {scattering("c", Kind::lognormal, 1, 2), scattering("c", Kind::gamma, 1, 1.2),
                             scattering("c", Kind::weibull, 0.7, 3)}) {
        study.factors = {study.factors[0], wide};
        EXPECT_THAT(refusal(study),
                    testing::AllOf(testing::HasSubstr("a point estimate takes 'c' at its mean "),
                                   testing::HasSubstr("lies above 0; use method = \"latin-hypercube\"")));
    }
    study.factors[1] = scattering("c", Kind::beta, 10, 20);
    study.factors[1].distribution->alpha = 5, study.factors[1].distribution->beta = 0.5;
    EXPECT_THAT(refusal(study), testing::HasSubstr("lies below 20"));
    study.factors[1] = scattering("c", Kind::lognormal, 1, 2);
    study.factors[1].distribution->least = 0.1;
    EXPECT_THAT(refusal(study), testing::HasSubstr("lies above 0.1"));
    // One deviation below its mean an exponential distribution ends.
    study.factors[1] = scattering("c", Kind::exponential, 4, 0);
    EXPECT_EQ(refusal(study), "");
    EXPECT_EQ(number_of(cases_of(study)[0].values[1].second), 0);
}

TEST(Design, APointEstimateRefusesNegativeWeights) {
    Study study = sampled(Design::Method::point_estimate, 0);
    study.design.correlations = {{0, 1, -0.4}, {0, 2, -0.4}, {1, 2, -0.4}};
    EXPECT_THAT(refusal(study),
                testing::AllOf(testing::HasSubstr("2 of the 8 runs"), testing::HasSubstr("negative weights"),
                               testing::HasSubstr("latin-hypercube")));
    for (auto& c : study.design.correlations) c.value = -1.0 / 3; // the corner where all are high has the weight 0
    EXPECT_EQ(refusal(study), "");
    study.design.method = Design::Method::latin_hypercube, study.design.samples = 50;
    for (auto& c : study.design.correlations) c.value = -0.4;
    EXPECT_EQ(refusal(study), "");
}

TEST(Design, CorrelationsThatCannotHoldTogetherAreSaid) {
    for (const auto method :
         {Design::Method::latin_hypercube, Design::Method::random, Design::Method::point_estimate}) {
        Study study = sampled(method, 10);
        study.design.correlations = {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}};
        try {
            cases_of(study);
            FAIL();
        } catch (const Diagnostic& error) { EXPECT_THAT(error.message, testing::HasSubstr("not positive definite")); }
    }
}

} // namespace
} // namespace kaya
