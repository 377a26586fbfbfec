// Distributions of the parameters of a study.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// A distribution of one number, cut off at `least` and `most`. `a` and `b` mean:
/// normal, lognormal, gamma: mean and standard deviation of the number itself; uniform: least and greatest value;
/// triangular: least and greatest value, `mode` between; exponential: mean; weibull: shape and scale;
/// beta: least and greatest value, with shapes `alpha` and `beta`.
struct Distribution {
    enum class Kind { normal, lognormal, uniform, triangular, exponential, weibull, gamma, beta };
    Kind kind = Kind::normal;
    double a = 0, b = 1;
    double mode = 0;
    double alpha = 1, beta = 1;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();

    /// The quantile of the fraction `p` (0 to 1, both excluded).
    double quantile(double p) const;
    /// Mean and standard deviation of the numbers between `least` and `most`; relative error below 1e-6.
    double mean() const;
    double deviation() const;
    /// All of its numbers lie between these.
    std::pair<double, double> range() const;
    /// "" when it is valid, otherwise the reason: "the deviation must be above 0".
    std::string mistake() const;
};

/// The names that a study file uses, in the order of Kind.
const std::vector<std::string>& distribution_names();

/// The number that a part `p` of standard normal numbers is below, and that part.
double normal_quantile(double p);
double normal_part(double x);

} // namespace kaya
