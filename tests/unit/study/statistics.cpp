#include "study/statistics.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace kaya {
namespace {

TEST(Statistics, MomentsOfNumbersAndOfAPointEstimate) {
    const auto m = moments_of({1, 2, std::nan(""), 3, 4}, {1, 1, 1, 1, 1});
    EXPECT_EQ(m.count, 4U);
    EXPECT_DOUBLE_EQ(m.mean, 2.5);
    EXPECT_DOUBLE_EQ(m.deviation, std::sqrt(5.0 / 3));
    EXPECT_EQ(m.least, 1);
    EXPECT_EQ(m.most, 4);
    const auto weighted = moments_of({0, 10}, {0.25, 0.75});
    EXPECT_DOUBLE_EQ(weighted.mean, 7.5);
    EXPECT_DOUBLE_EQ(weighted.deviation, std::sqrt(0.25 * 56.25 + 0.75 * 6.25));
}

TEST(Statistics, TheIntervalOfAProbability) {
    // Clopper and Pearson for 3 of 20, from tables: 0.0321 to 0.3789.
    std::vector<double> truths(20, 0.0), weights(20, 1.0);
    truths[1] = truths[7] = truths[19] = 1;
    const auto p = probability_of(truths, weights);
    EXPECT_DOUBLE_EQ(p.value, 0.15);
    EXPECT_NEAR(p.low, 0.0321, 5e-5);
    EXPECT_NEAR(p.high, 0.3789, 5e-5);
    const auto none = probability_of(std::vector<double>(10, 0.0), std::vector<double>(10, 1.0));
    EXPECT_EQ(none.low, 0);
    EXPECT_NEAR(none.high, 1 - std::pow(0.025, 0.1), 1e-9);
}

TEST(Statistics, RankCorrelationTakesOrderOnly) {
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}), 1);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {-1, -2, -3, -4}), -1);
    EXPECT_EQ(rank_correlation({1, 2, 3}, {5, 5, 5}), 0);
    EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 1, 2, 2}), 2 / std::sqrt(5), 1e-12); // shared ranks
}

std::vector<Case> grid_cases() {
    std::vector<Case> cases;
    for (const double x : {1.0, 2.0, 3.0, 4.0})
        for (const double y : {1e9, 2e9, 5e9}) {
            Case one;
            one.number = cases.size() + 1;
            one.values = {{"x", StudyValue(x)}, {"y", StudyValue(y)}, {"law", StudyValue(std::string("mohr"))}};
            cases.push_back(one);
        }
    return cases;
}

TEST(Statistics, AResponseSurfaceFindsAPolynomialInUnitsOfAnySize) {
    const auto cases = grid_cases();
    std::vector<Outcome> outcomes(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double x = number_of(cases[i].values[0].second), y = number_of(cases[i].values[1].second);
        outcomes[i].results = {{"f", StudyValue(3 + 2 * x - 1e-9 * y + 5e-10 * x * y + 0.25 * x * x)}};
    }
    const auto response = response_of("f", cases, outcomes);
    ASSERT_TRUE(response);
    EXPECT_NEAR(response->determination, 1, 1e-12);
    ASSERT_EQ(response->terms.size(), 6U);
    EXPECT_EQ(response->terms[4].name, "x y");
    EXPECT_NEAR(response->terms[0].factor, 3, 1e-6);
    EXPECT_NEAR(response->terms[1].factor, 2, 1e-6);
    EXPECT_NEAR(response->terms[2].factor, -1e-9, 1e-15);
    EXPECT_NEAR(response->terms[4].factor, 5e-10, 1e-15);
    outcomes.resize(5);
    EXPECT_FALSE(response_of("f", {cases.begin(), cases.begin() + 5}, outcomes)); // six coefficients from five runs
}

TEST(Statistics, ATornadoHasTheLongestBarFirst) {
    Study study;
    study.design.method = Design::Method::one_at_a_time;
    study.tornado_of = "f";
    study.factors = {{"a", {StudyValue(1.0), StudyValue(3.0)}, {}, StudyValue(2.0), {}},
                     {"b", {StudyValue(10.0), StudyValue(30.0)}, {}, StudyValue(20.0), {}}};
    const auto cases = cases_of(study);
    std::vector<Outcome> outcomes;
    for (const auto& one : cases) {
        outcomes.emplace_back();
        outcomes.back().results = {
            {"f", StudyValue(number_of(one.values[0].second) - number_of(one.values[1].second))}};
    }
    const auto bars = tornado_of(study, cases, outcomes);
    ASSERT_EQ(bars.size(), 2U);
    EXPECT_EQ(bars[0].parameter, "b");
    EXPECT_EQ(bars[0].low, 2 - 10);
    EXPECT_EQ(bars[0].high, 2 - 30);
    EXPECT_EQ(bars[1].length(), 2);
}

} // namespace
} // namespace kaya
