#include "study/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/exponential.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <exception>

namespace kaya {

namespace {

namespace bm = boost::math;

/// Calls `use` with Boost's distribution. A beta distribution is that between 0 and 1.
template <class Use> auto with(const Distribution& d, Use&& use) {
    using Kind = Distribution::Kind;
    switch (d.kind) {
    case Kind::lognormal: {
        const double variance = std::log1p(d.b * d.b / (d.a * d.a)); // of the logarithm
        return use(bm::lognormal(std::log(d.a) - 0.5 * variance, std::sqrt(variance)));
    }
    case Kind::uniform: return use(bm::uniform(d.a, d.b));
    case Kind::triangular: return use(bm::triangular(d.a, d.mode, d.b));
    case Kind::exponential: return use(bm::exponential(1 / d.a));
    case Kind::weibull: return use(bm::weibull(d.a, d.b));
    case Kind::gamma: return use(bm::gamma_distribution<>(d.a * d.a / (d.b * d.b), d.b * d.b / d.a));
    case Kind::beta: return use(bm::beta_distribution<>(d.alpha, d.beta));
    case Kind::normal: break;
    }
    return use(bm::normal(d.a, d.b));
}

/// Where `is_below` changes from true to false, to the last bit.
template <class IsBelow> double halved(std::pair<double, double> range, IsBelow&& is_below) {
    auto [low, high] = range;
    for (;;) {
        const double middle = 0.5 * low + 0.5 * high;
        if (!(middle > low && middle < high)) return low;
        (is_below(middle) ? low : high) = middle;
    }
}

/// Quantiles. Boost finds none of some beta distributions.
template <class Dist> double number_at(const Dist& dist, double part) {
    try {
        return bm::quantile(dist, part);
    } catch (const bm::evaluation_error&) {
        return halved(bm::support(dist), [&](double x) { return bm::cdf(dist, x) < part; });
    }
}
template <class Dist> double number_at(const bm::complemented2_type<Dist, double>& above) {
    try {
        return bm::quantile(above);
    } catch (const bm::evaluation_error&) {
        return halved(bm::support(above.dist),
                      [&](double x) { return bm::cdf(bm::complement(above.dist, x)) > above.param; });
    }
}

/// Converts a number of Boost's distribution to one of ours.
double scaled(const Distribution& d, double x) {
    return d.kind == Distribution::Kind::beta ? d.a + (d.b - d.a) * x : x;
}
double unscaled(const Distribution& d, double x) {
    return d.kind == Distribution::Kind::beta ? (x - d.a) / (d.b - d.a) : x;
}

/// The cumulative probability at `x`, which may be outside of the range of the distribution.
double part_below(const Distribution& d, double x) {
    return with(d, [&](const auto& dist) {
        const auto [low, high] = bm::support(dist);
        const double value = unscaled(d, x);
        return value <= low ? 0.0 : value >= high ? 1.0 : bm::cdf(dist, value);
    });
}

double part_below_least(const Distribution& d) { return std::isfinite(d.least) ? part_below(d, d.least) : 0; }

/// The probability between its limits.
double part_inside(const Distribution& d) {
    return (std::isfinite(d.most) ? part_below(d, d.most) : 1) - part_below_least(d);
}

/// Probabilities of a distribution below, above and between its limits.
struct Cut {
    double below = 0, above = 0, inside = 1;
};

Cut cut_of(const Distribution& d) {
    return with(d, [&](const auto& dist) {
        const auto [low, high] = bm::support(dist);
        const double least = unscaled(d, d.least), most = unscaled(d, d.most);
        Cut cut;
        if (std::isfinite(d.least) && least > low) cut.below = least >= high ? 1 : bm::cdf(dist, least);
        if (std::isfinite(d.most) && most < high) cut.above = most <= low ? 1 : bm::cdf(bm::complement(dist, most));
        // The difference of the two smaller numbers has the more digits.
        if (cut.below <= 0.5) cut.inside = 1 - cut.above - cut.below;
        else cut.inside = (least >= high ? 0 : bm::cdf(bm::complement(dist, least))) - cut.above;
        return cut;
    });
}

/// The mean of `use` over a truncated distribution: the integral over the quantile function by Takahasi and Mori (1974), whose points crowd
/// at both ends, where the function may be infinite. Each half takes the side of the distribution that has the more digits.
template <class Use> double mean_over(const Distribution& d, const Cut& cut, Use&& use) {
    thread_local bm::quadrature::tanh_sinh<double> quadrature(10);
    constexpr double least_part = 1e-30, tolerance = 1e-10;
    const auto at = [&](double value) { return use(std::clamp(scaled(d, value), d.least, d.most)); };
    return with(d, [&](const auto& dist) {
        const auto from_below = [&](double part) {
            return at(number_at(dist, std::max(cut.below + part * cut.inside, least_part)));
        };
        const auto from_above = [&](double part) {
            return at(number_at(bm::complement(dist, std::max(cut.above + part * cut.inside, least_part))));
        };
        const auto lower = [&](double part) { return cut.below > 0.5 ? from_above(1 - part) : from_below(part); };
        const auto upper = [&](double part) { return cut.above > 0.5 ? from_below(1 - part) : from_above(part); };
        return quadrature.integrate(lower, 0.0, 0.5, tolerance) + quadrature.integrate(upper, 0.0, 0.5, tolerance);
    });
}

} // namespace

double Distribution::quantile(double p) const {
    const double part = part_below_least(*this) + p * part_inside(*this);
    const double value =
        with(*this, [&](const auto& dist) { return number_at(dist, std::clamp(part, 1e-300, 1 - 1e-16)); });
    return std::clamp(scaled(*this, value), least, most);
}

double Distribution::mean() const {
    if (const Cut cut = cut_of(*this); cut.inside < 1) return mean_over(*this, cut, [](double x) { return x; });
    return with(*this, [&](const auto& dist) { return scaled(*this, bm::mean(dist)); });
}

double Distribution::deviation() const {
    if (const Cut cut = cut_of(*this); cut.inside < 1) {
        const double middle = mean();
        return std::sqrt(mean_over(*this, cut, [&](double x) { return (x - middle) * (x - middle); }));
    }
    const double own = with(*this, [](const auto& dist) { return bm::standard_deviation(dist); });
    return kind == Kind::beta ? own * (b - a) : own;
}

std::pair<double, double> Distribution::range() const {
    const auto [low, high] = with(*this, [&](const auto& dist) {
        auto [from, to] = bm::support(dist);
        if (from > 0 && from < 1e-300) from = 0; // Boost excludes zero, a limit of the distribution
        return std::pair{scaled(*this, from), scaled(*this, to)};
    });
    return {std::max(low, least), std::min(high, most)};
}

std::string Distribution::mistake() const {
    for (const double number : {a, b, mode, alpha, beta})
        if (!std::isfinite(number)) return "its numbers must be finite";
    if (std::isnan(least) || std::isnan(most)) return "its limits must be numbers";
    const bool has_deviation = kind == Kind::normal || kind == Kind::lognormal || kind == Kind::gamma;
    if (has_deviation && !(b > 0)) return "the deviation must be above 0";
    if ((kind == Kind::lognormal || kind == Kind::gamma || kind == Kind::exponential) && !(a > 0))
        return "the mean must be above 0";
    if (kind == Kind::weibull && !(a > 0 && b > 0)) return "shape and scale must be above 0";
    const bool has_ends = kind == Kind::uniform || kind == Kind::triangular || kind == Kind::beta;
    if (has_ends && !(a < b)) return "'from' must be below 'to'";
    if (kind == Kind::triangular && !(mode >= a && mode <= b)) return "'mode' must lie between 'from' and 'to'";
    if (kind == Kind::beta && !(alpha > 0 && beta > 0)) return "'alpha' and 'beta' must be above 0";
    if (!(least < most)) return "'least' must be below 'most'";
    try {
        if (!(part_inside(*this) > 1e-9)) return "nothing of it lies between 'least' and 'most'";
        if (std::isfinite(quantile(0.5)) && std::isfinite(mean()) && std::isfinite(deviation())) return {};
    } catch (const std::exception&) {} // of Boost: what it derives from the numbers is infinite
    return "its numbers are too large, too small or too far apart to compute with";
}

const std::vector<std::string>& distribution_names() {
    static const std::vector<std::string> names{"normal",      "lognormal", "uniform", "triangular",
                                                "exponential", "weibull",   "gamma",   "beta"};
    return names;
}

double normal_quantile(double p) { return bm::quantile(bm::normal(), p); }
double normal_part(double x) { return bm::cdf(bm::normal(), x); }

} // namespace kaya
