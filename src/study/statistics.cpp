#include "study/statistics.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace kaya {

namespace {

/// Ranks from 1 on; equal numbers share the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& numbers) {
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    std::vector<double> ranks(numbers.size());
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first;
        while (end < order.size() && numbers[order[end]] == numbers[order[first]]) ++end;
        for (std::size_t i = first; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
        first = end;
    }
    return ranks;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n,
                 mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

/// The parameters that are numbers and differ from run to run.
std::vector<std::size_t> numeric_columns(const std::vector<Case>& cases) {
    std::vector<std::size_t> columns;
    if (cases.empty()) return columns;
    for (std::size_t j = 0; j < cases[0].values.size(); ++j) {
        const auto number = [&](const Case& one) { return number_of(one.values[j].second); };
        const bool all = std::ranges::all_of(cases, [&](const Case& one) { return !std::isnan(number(one)); });
        const bool varies =
            std::ranges::any_of(cases, [&](const Case& one) { return number(one) != number(cases[0]); });
        if (all && varies) columns.push_back(j);
    }
    return columns;
}

std::vector<Bar> bars_one_at_a_time(const Study& study, const std::vector<Case>& cases,
                                    const std::vector<Outcome>& outcomes) {
    std::vector<Bar> bars;
    for (std::size_t j = 0; j < study.factors.size(); ++j) {
        const auto& factor = study.factors[j];
        const auto result_at = [&](const StudyValue& value) {
            for (std::size_t i = 0; i < cases.size(); ++i) {
                const auto& values = cases[i].values;
                bool wanted = values[j].second == value;
                for (std::size_t k = 0; k < study.factors.size() && wanted; ++k)
                    wanted = k == j || values[k].second == *study.factors[k].base;
                if (wanted) return number_of(result_of(outcomes[i], study.tornado_of));
            }
            return std::numeric_limits<double>::quiet_NaN();
        };
        const Bar bar{factor.name, result_at(factor.values.front()), result_at(factor.values.back()),
                      text_of(factor.values.front()), text_of(factor.values.back())};
        if (!std::isnan(bar.low) && !std::isnan(bar.high)) bars.push_back(bar);
    }
    return bars;
}

} // namespace

Moments moments_of(const std::vector<double>& numbers, const std::vector<double>& weights) {
    std::vector<std::pair<double, double>> sorted;
    double all = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!std::isnan(numbers[i])) sorted.emplace_back(numbers[i], weights[i]), all += weights[i];
    Moments m;
    m.count = sorted.size();
    if (sorted.empty()) return m;
    std::ranges::sort(sorted);
    for (const auto& [number, weight] : sorted) m.mean += weight * number / all;
    for (const auto& [number, weight] : sorted) m.deviation += weight * (number - m.mean) * (number - m.mean) / all;
    // Random runs estimate the scatter from n - 1 of them; in a point estimate it is known.
    const bool estimated = std::ranges::any_of(weights, [](double weight) { return weight != 1; });
    const double n = static_cast<double>(sorted.size());
    m.deviation = std::sqrt(std::max(0.0, m.deviation) * (estimated || n < 2 ? 1 : n / (n - 1)));
    m.least = sorted.front().first, m.most = sorted.back().first;
    const auto at = [&](double part) {
        double below = 0;
        for (const auto& [number, weight] : sorted)
            if ((below += weight) >= part * all) return number;
        return sorted.back().first;
    };
    m.low = at(0.05), m.high = at(0.95);
    // Between two runs with half of the weight on each side: their mean.
    constexpr double rounding = 1e-9;
    m.median = 0.5 * (at(0.5 * (1 - rounding)) + at(0.5 * (1 + rounding)));
    return m;
}

Probability probability_of(const std::vector<double>& truths, const std::vector<double>& weights) {
    Probability p;
    double all = 0, hits = 0;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        if (std::isnan(truths[i])) continue;
        ++p.count, all += weights[i];
        if (truths[i] != 0) ++p.hits, hits += weights[i];
    }
    if (p.count == 0) return p;
    p.value = hits / all;
    p.has_interval = std::ranges::all_of(weights, [](double weight) { return weight == 1; });
    if (!p.has_interval) return p;
    using Binomial = boost::math::binomial_distribution<double>;
    const auto n = static_cast<double>(p.count), k = static_cast<double>(p.hits);
    p.low = p.hits == 0 ? 0 : Binomial::find_lower_bound_on_p(n, k, 0.025);
    p.high = p.hits == p.count ? 1 : Binomial::find_upper_bound_on_p(n, k, 0.025);
    return p;
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> xs, ys;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isnan(x[i]) && !std::isnan(y[i])) xs.push_back(x[i]), ys.push_back(y[i]);
    return xs.size() < 2 ? 0 : correlation(ranks_of(xs), ranks_of(ys));
}

std::vector<Bar> tornado_of(const Study& study, const std::vector<Case>& cases, const std::vector<Outcome>& outcomes) {
    std::vector<Bar> bars;
    if (study.design.method == Design::Method::one_at_a_time) {
        bars = bars_one_at_a_time(study, cases, outcomes);
    } else {
        std::vector<double> results;
        for (const auto& outcome : outcomes) results.push_back(number_of(result_of(outcome, study.tornado_of)));
        for (const std::size_t j : numeric_columns(cases)) {
            std::vector<double> numbers;
            for (const auto& one : cases) numbers.push_back(number_of(one.values[j].second));
            bars.push_back({cases[0].values[j].first, 0, rank_correlation(numbers, results), "", ""});
        }
    }
    std::ranges::stable_sort(bars, [](const Bar& a, const Bar& b) { return a.length() > b.length(); });
    return bars;
}

std::optional<Response> response_of(const std::string& result, const std::vector<Case>& cases,
                                    const std::vector<Outcome>& outcomes) {
    const auto columns = numeric_columns(cases);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (std::isfinite(number_of(result_of(outcomes[i], result)))) rows.push_back(i);
    const std::size_t n = columns.size(), terms = 1 + n + n * (n + 1) / 2;
    if (n == 0 || rows.size() < terms) return std::nullopt;
    Response response;
    std::vector<std::pair<std::size_t, std::size_t>> products; // of columns; n: 1
    products.emplace_back(n, n);
    for (std::size_t j = 0; j < n; ++j) products.emplace_back(j, n);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = j; k < n; ++k) products.emplace_back(j, k);
    Eigen::MatrixXd matrix(rows.size(), products.size());
    Eigen::VectorXd right(rows.size());
    const auto number = [&](std::size_t row, std::size_t j) {
        return j == n ? 1.0 : number_of(cases[row].values[columns[j]].second);
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        right(static_cast<Eigen::Index>(i)) = number_of(result_of(outcomes[rows[i]], result));
        for (std::size_t t = 0; t < products.size(); ++t)
            matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(t)) =
                number(rows[i], products[t].first) * number(rows[i], products[t].second);
    }
    // Scales columns to one size: a modulus in Pa is next to a friction angle. Terms that the runs do not determine get the smallest
    // factors.
    const Eigen::VectorXd scale = matrix.colwise().norm().cwiseMax(1e-300);
    const Eigen::VectorXd solution = (matrix * scale.cwiseInverse().asDiagonal())
                                         .completeOrthogonalDecomposition()
                                         .solve(right)
                                         .cwiseQuotient(scale);
    const auto name = [&](std::size_t j) { return cases[0].values[columns[j]].first; };
    for (std::size_t t = 0; t < products.size(); ++t) {
        const auto [one, other] = products[t];
        const std::string text = one == n       ? "1"
                                 : other == n   ? name(one)
                                 : one == other ? name(one) + "^2"
                                                : name(one) + " " + name(other);
        response.terms.push_back({text, solution(static_cast<Eigen::Index>(t))});
    }
    const double rest = (matrix * solution - right).squaredNorm(),
                 all = (right.array() - right.mean()).matrix().squaredNorm();
    response.determination = all > 0 ? 1 - rest / all : 1;
    return response;
}

} // namespace kaya
