#include "study/statistics.hpp"
#include "study/study_answers.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

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

TEST(Statistics, FailedRunsBoundAProbability) {
    std::vector<double> truths(400, 0.0);
    const std::vector<double> ones(400, 1.0);
    for (std::size_t i = 0; i < 124; ++i) truths[i] = i < 61 ? 1 : std::nan("");
    const auto p = probability_of(truths, ones);
    EXPECT_TRUE(std::isnan(p.value));
    EXPECT_DOUBLE_EQ(p.least, 61.0 / 400);
    EXPECT_DOUBLE_EQ(p.most, 124.0 / 400);
    EXPECT_EQ(p.missing, 63u);
    EXPECT_LT(p.low, p.least);
    EXPECT_GT(p.high, p.most);
    std::vector<double> all(400, 0.0);
    std::fill(all.begin(), all.begin() + 124, 1.0);
    EXPECT_DOUBLE_EQ(p.high, probability_of(all, ones).high);
    // Of a point estimate: bounds by the weights.
    const auto corners = probability_of({1, 0, std::nan(""), 0}, {0.25, 0.25, 0.25, 0.25});
    EXPECT_DOUBLE_EQ(corners.least, 0.25);
    EXPECT_DOUBLE_EQ(corners.most, 0.5);
    EXPECT_TRUE(std::isnan(corners.value));
    EXPECT_FALSE(corners.has_interval);
}

TEST(Statistics, AProbabilityCountsTruthsAlone) {
    const auto margins = probability_of({-2, -1}, {1, 1});
    EXPECT_FALSE(margins.counts_truths);
    EXPECT_TRUE(std::isnan(margins.value));
}

TEST(Statistics, MomentsThatAreNotKnown) {
    EXPECT_TRUE(std::isnan(moments_of({5}, {1}).deviation));
    EXPECT_EQ(moments_of({5}, {1}).mean, 5);
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(moments_of({-1, infinite, 1}, {1, 1, 1}).deviation));
    const auto corners = moments_of({1, 2, std::nan(""), 4}, {0.25, 0.25, 0.25, 0.25});
    EXPECT_TRUE(std::isnan(corners.mean) && std::isnan(corners.deviation));
    EXPECT_EQ(corners.missing, 1u);
}

TEST(Statistics, WithoutAResultNothingIsKnown) {
    const std::vector<double> none(4, std::nan("")), ones(4, 1.0);
    EXPECT_TRUE(std::isnan(probability_of(none, ones).value));
    EXPECT_FALSE(probability_of(none, ones).has_interval);
    EXPECT_TRUE(std::isnan(probability_of({}, {}).value));
    EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3, 4}, none, ones)));
    EXPECT_TRUE(std::isnan(rank_correlation({1, 2}, {3, std::nan("")}, {1, 1})));
}

TEST(Statistics, RankCorrelationTakesOrderOnly) {
    const std::vector<double> w(4, 1.0);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}, w), 1);
    EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {-1, -2, -3, -4}, w), -1);
    EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {5, 5, 5}, w)));
    EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {5, 5, 5}, {0.1, 0.2, 0.7})));
    EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 1, 2, 2}, w), 2 / std::sqrt(5), 1e-12); // shared ranks
}

TEST(Statistics, AWeightIsThatOfSoManyRuns) {
    std::mt19937 generator(5);
    for (int k = 0; k < 20; ++k) {
        std::vector<double> x, y, weights, many_x, many_y;
        for (int i = 0; i < 12; ++i) {
            x.push_back(static_cast<double>(generator() % 7)), y.push_back(static_cast<double>(generator() % 9));
            const auto times = generator() % 4;
            weights.push_back(static_cast<double>(times) / 64);
            many_x.insert(many_x.end(), times, x.back()), many_y.insert(many_y.end(), times, y.back());
        }
        EXPECT_NEAR(rank_correlation(x, y, weights),
                    rank_correlation(many_x, many_y, std::vector<double>(many_x.size(), 1.0)), 1e-12);
    }
}

/// Runs of a + slope * b.
std::vector<Outcome> sums(const std::vector<Case>& cases, double slope) {
    std::vector<Outcome> outcomes;
    for (const auto& one : cases) {
        outcomes.emplace_back();
        outcomes.back().results = {
            {"f", StudyValue(number_of(one.values[0].second) + slope * number_of(one.values[1].second))}};
    }
    return outcomes;
}

/// Two correlated normal parameters: the correlation of a with a + slope b is (sa + rho slope sb) / s. That of ranks has its sign.
TEST(Statistics, CorrelationsOfAPointEstimateHaveItsWeights) {
    for (const double rho : {-0.8, -0.3, 0.0, 0.6})
        for (const double slope : {-1.0, 0.5, 3.0}) {
            Study study;
            study.design.method = Design::Method::point_estimate;
            study.tornado_of = "f";
            Distribution a, b;
            a.a = 5, a.b = 2, b.a = 10, b.b = 1;
            study.factors = {{"a", {}, a, {}, {}}, {"b", {}, b, {}, {}}};
            if (rho != 0) study.design.correlations = {{0, 1, rho}};
            const auto cases = cases_of(study);
            for (const auto& bar : tornado_of(study, cases, sums(cases, slope))) {
                const double own = bar.parameter == "a" ? 2 : slope, other = bar.parameter == "a" ? slope : 2;
                const double exact = (own + rho * other) / std::sqrt(own * own + other * other + 2 * rho * own * other);
                if (std::abs(exact) < 0.1) continue;
                EXPECT_GT(bar.high * exact, 0) << rho << ' ' << slope << ' ' << bar.parameter;
            }
        }
}

TEST(Statistics, TheTornadoOfAConstantResultIsNotKnown) {
    Study study;
    study.tornado_of = "f";
    study.factors = {{"a", {StudyValue(1.0), StudyValue(2.0), StudyValue(3.0)}, {}, {}, {}},
                     {"b", {StudyValue(4.0), StudyValue(5.0)}, {}, {}, {}}};
    const auto cases = cases_of(study);
    for (const auto& bar : tornado_of(study, cases, std::vector<Outcome>(6))) EXPECT_FALSE(bar.is_known());
    auto outcomes = sums(cases, 0);
    const auto bars = tornado_of(study, cases, outcomes);
    ASSERT_EQ(bars.size(), 2U);
    EXPECT_EQ(bars[0].parameter, "a");
    EXPECT_DOUBLE_EQ(bars[0].high, 1);
    EXPECT_EQ(bars[1].high, 0); // it has no effect, which is known
    for (auto& outcome : outcomes) outcome.results[0].second = StudyValue(0.1);
    for (const auto& bar : tornado_of(study, cases, outcomes)) EXPECT_FALSE(bar.is_known());
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

std::vector<std::string> names_of(const std::vector<Response::Term>& terms) {
    std::vector<std::string> names;
    for (const auto& term : terms) names.push_back(term.name);
    return names;
}

/// One value with the others at their base: no products. Numbers near 1000 differ by 1 only.
TEST(Statistics, AResponseSurfaceLeavesOutWhatTheRunsDoNotDetermine) {
    for (const double base : {0.0, 30.0, 1000.0, 5e4}) {
        Study study;
        study.design.method = Design::Method::one_at_a_time;
        study.factors = {
            {"a", {StudyValue(base - 1), StudyValue(base - 0.5), StudyValue(base + 1)}, {}, StudyValue(base), {}},
            {"b", {StudyValue(2.0), StudyValue(4.0), StudyValue(5.0)}, {}, StudyValue(3.0), {}}};
        const auto cases = cases_of(study);
        std::vector<Outcome> outcomes;
        for (const auto& one : cases) {
            const double a = number_of(one.values[0].second) - base, b = number_of(one.values[1].second);
            outcomes.emplace_back();
            outcomes.back().results = {{"f", StudyValue(1 + 2 * a + 3 * a * a - b * b)}};
        }
        const auto response = response_of("f", cases, outcomes);
        ASSERT_TRUE(response);
        EXPECT_EQ(response->undetermined, std::vector<std::string>{"a b"});
        EXPECT_EQ(names_of(response->terms), (std::vector<std::string>{"1", "a", "b", "a^2", "b^2"}));
        EXPECT_NEAR(response->determination, 1, 1e-9);
        EXPECT_NEAR(response->terms[3].factor, 3, 1e-3);
        EXPECT_NEAR(response->terms[4].factor, -1, 1e-3);
    }
}

/// Two values of each parameter: squares are constants there. As many terms as runs: nothing is left to judge by.
TEST(Statistics, AResponseSurfaceKnowsItsAliases) {
    std::vector<Case> cases;
    std::vector<Outcome> outcomes;
    for (int corner = 0; corner < 32; ++corner) {
        cases.emplace_back();
        double sum = 0, product = 1;
        for (int j = 0; j < 5; ++j) {
            const double value = corner >> j & 1 ? 7.5 : 2.5;
            cases.back().values.emplace_back(std::string(1, static_cast<char>('a' + j)), StudyValue(value));
            sum += (j + 1) * value, product *= value;
        }
        outcomes.emplace_back();
        outcomes.back().results = {{"f", StudyValue(sum)}, {"g", StudyValue(product)}, {"h", StudyValue(0.1)}};
    }
    const auto response = response_of("f", cases, outcomes);
    ASSERT_TRUE(response);
    EXPECT_EQ(response->undetermined, (std::vector<std::string>{"a^2", "b^2", "c^2", "d^2", "e^2"}));
    ASSERT_EQ(response->terms.size(), 16U);
    for (std::size_t t = 0; t < 16; ++t)
        EXPECT_NEAR(response->terms[t].factor, t >= 1 && t <= 5 ? static_cast<double>(t) : 0, 1e-9);
    EXPECT_LT(response_of("g", cases, outcomes)->determination, 0.999); // products of three are missing
    EXPECT_TRUE(std::isnan(response_of("h", cases, outcomes)->determination));
}

TEST(Statistics, AResponseSurfaceThroughAllRunsHasNoQuality) {
    auto cases = grid_cases();
    cases.erase(cases.begin() + 6, cases.end()); // two values of x, three of y
    std::vector<Outcome> outcomes(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
        outcomes[i].results = {{"f", StudyValue(std::sin(17.0 * static_cast<double>(i)))}};
    const auto five = response_of("f", cases, outcomes);
    ASSERT_TRUE(five);
    EXPECT_EQ(five->undetermined, std::vector<std::string>{"x^2"});
    EXPECT_LT(five->determination, 1);
    cases[5].values[0].second = StudyValue(3.0);
    const auto six = response_of("f", cases, outcomes);
    ASSERT_TRUE(six);
    EXPECT_EQ(six->terms.size(), 6U);
    EXPECT_TRUE(std::isnan(six->determination));
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

TEST(Statistics, ASummarySaysWhatIsNotKnown) {
    Study study;
    study.probability_of = study.tornado_of = study.response_of = "f";
    StudyAnswers answers;
    answers.probability = probability_of({std::nan("")}, {1});
    answers.tornado = {{"a", 0, std::nan(""), "", ""}, {"b", 1, std::nan(""), "20", "40"}};
    answers.response = Response{{{"1", 2}, {"a", -3}}, {"a^2", "a b"}, std::nan("")};
    EXPECT_EQ(summary_text(study, answers), "0 runs: 0 done\n"
                                            "probability of 'f': unknown, no run has a value\n"
                                            "sensitivity of 'f':\n"
                                            "  a: rank correlation unknown\n"
                                            "  b: 1 at 20 to unknown at 40\n"
                                            "'f' is about, with R^2 = unknown:\n"
                                            "  +2 * 1\n"
                                            "  -3 * a\n"
                                            "  left out, as these runs do not determine them: a^2, a b\n");
    EXPECT_EQ(report_page(study, answers, "1").find("nan"), std::string::npos);
}

} // namespace
} // namespace kaya
