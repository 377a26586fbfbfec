// Statistics over the results of a study. All skip runs without a number.
#pragma once

#include "study/outcome.hpp"
#include "study/study.hpp"

#include <optional>
#include <string>
#include <vector>

namespace kaya {

/// Of numbers with weights; quantiles use the weights as fractions. The deviation of one number is not known (NaN), nor are mean and deviation
/// of a point estimate that lacks a run.
struct Moments {
    std::size_t count = 0, missing = 0;
    double mean = 0, deviation = 0, least = 0, most = 0, low = 0, median = 0,
           high = 0; ///< low and high: 5 and 95 % of all are below
};
Moments moments_of(const std::vector<double>& numbers, const std::vector<double>& weights);

/// How often something is true, and the interval that holds the true part with 95 % (Clopper and Pearson 1934). Of a point estimate:
/// no interval. Runs without a value may be either: the part is then between `least` and `most`, the interval holds both, and `value` is NaN.
/// All are NaN when no run has a value, or when one is neither 0 nor 1.
struct Probability {
    std::size_t count = 0, hits = 0, missing = 0;
    double value = 0, least = 0, most = 0, low = 0, high = 1;
    bool has_interval = true, counts_truths = true;
};
Probability probability_of(const std::vector<double>& truths, const std::vector<double>& weights);

/// Rank correlation of both; NaN where one does not vary.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& weights);

/// A bar of a tornado plot. One at a time: the result at the lowest and highest value of the parameter; otherwise the rank correlation in `high`.
/// NaN where a number is not known.
struct Bar {
    std::string parameter;
    double low = 0, high = 0;
    std::string low_text, high_text; ///< values of the parameter
    double length() const { return high > low ? high - low : low - high; }
    bool is_known() const { return low == low && high == high; }
};
std::vector<Bar> tornado_of(const Study& study, const std::vector<Case>& cases, const std::vector<Outcome>& outcomes);

/// A polynomial of the second degree in the parameters that are numbers, by least squares.
struct Response {
    struct Term {
        std::string name; ///< "1", "friction", "friction cohesion", "friction^2"
        double factor = 0;
    };
    std::vector<Term> terms;               ///< that the runs determine
    std::vector<std::string> undetermined; ///< combinations, at these runs, of the terms before them
    double determination = 0; ///< R squared; NaN when as many terms as runs, or a constant result, leave none
};
/// None when there are too few runs for it.
std::optional<Response> response_of(const std::string& result, const std::vector<Case>& cases,
                                    const std::vector<Outcome>& outcomes);

} // namespace kaya
