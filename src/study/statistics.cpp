#include "study/statistics.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <numeric>

namespace kaya {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Ranks from 1 on, where each number counts with its weight; equal numbers share the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& numbers, const std::vector<double>& weights) {
    std::vector<std::size_t> order(numbers.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
    std::vector<double> ranks(numbers.size());
    double below = 0;
    for (std::size_t first = 0; first < order.size();) {
        std::size_t end = first;
        double equal = 0;
        while (end < order.size() && numbers[order[end]] == numbers[order[first]]) equal += weights[order[end++]];
        for (std::size_t i = first; i < end; ++i) ranks[order[i]] = below + 0.5 * (equal + 1);
        below += equal;
        first = end;
    }
    return ranks;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& weights) {
    const double n = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double mean_x = std::inner_product(x.begin(), x.end(), weights.begin(), 0.0) / n,
                 mean_y = std::inner_product(y.begin(), y.end(), weights.begin(), 0.0) / n;
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += weights[i] * (x[i] - mean_x) * (x[i] - mean_x);
        yy += weights[i] * (y[i] - mean_y) * (y[i] - mean_y);
        xy += weights[i] * (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xy / std::sqrt(xx * yy);
}

bool varies(const std::vector<double>& numbers) {
    return std::ranges::any_of(numbers, [&](double number) { return number != numbers[0]; });
}

/// The parameters that are numbers and differ from run to run.
std::vector<std::size_t> numeric_columns(const std::vector<Case>& cases) {
    std::vector<std::size_t> columns;
    if (cases.empty()) return columns;
    for (std::size_t j = 0; j < cases[0].values.size(); ++j) {
        const auto number = [&](const Case& one) { return number_of(one.values[j].second); };
        const bool all = std::ranges::all_of(cases, [&](const Case& one) { return !std::isnan(number(one)); });
        const bool differ =
            std::ranges::any_of(cases, [&](const Case& one) { return number(one) != number(cases[0]); });
        if (all && differ) columns.push_back(j);
    }
    return columns;
}

std::vector<Bar> bars_one_at_a_time(const Study& study, const std::vector<Case>& cases,
                                    const std::vector<Outcome>& outcomes) {
    std::vector<Bar> bars;
    for (std::size_t j = 0; j < study.factors.size(); ++j) {
        const auto& factor = study.factors[j];
        // By size where they are numbers, else the first and the last.
        auto low = factor.values.begin(), high = std::prev(factor.values.end());
        if (std::ranges::none_of(factor.values, [](const auto& value) { return std::isnan(number_of(value)); })) {
            const auto [least, most] = std::ranges::minmax_element(factor.values, {}, number_of);
            low = least, high = most;
        }
        const auto result_at = [&](const StudyValue& value) {
            for (std::size_t i = 0; i < cases.size(); ++i) {
                const auto& values = cases[i].values;
                bool wanted = values[j].second == value;
                for (std::size_t k = 0; k < study.factors.size() && wanted; ++k)
                    wanted = k == j || values[k].second == *study.factors[k].base;
                if (wanted) return known_number(outcomes[i], study.tornado_of);
            }
            return unknown;
        };
        bars.push_back({factor.name, result_at(*low), result_at(*high), text_of(*low), text_of(*high)});
    }
    return bars;
}

/// A term of a polynomial: the product of two columns, where the number of columns is 1.
using Product = std::pair<std::size_t, std::size_t>;

/// All terms up to the second degree of n columns, by degree.
std::vector<Product> products_of(std::size_t n) {
    std::vector<Product> products{{n, n}};
    for (std::size_t j = 0; j < n; ++j) products.emplace_back(j, n);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = j; k < n; ++k) products.emplace_back(j, k);
    return products;
}

Eigen::MatrixXd columns_of(const Eigen::MatrixXd& numbers, const std::vector<Product>& products) {
    Eigen::MatrixXd matrix(numbers.rows(), products.size());
    const auto number = [&](Eigen::Index row, std::size_t j) {
        const auto column = static_cast<Eigen::Index>(j);
        return column == numbers.cols() ? 1.0 : numbers(row, column);
    };
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        for (std::size_t t = 0; t < products.size(); ++t)
            matrix(i, static_cast<Eigen::Index>(t)) = number(i, products[t].first) * number(i, products[t].second);
    return matrix;
}

/// Whether the runs determine each term: false for a combination of terms before it. Parameters count from their middle, in parts of their
/// range, so that a modulus from 1000 to 1001 is not taken for a constant.
std::vector<bool> determined_by(Eigen::MatrixXd numbers, const std::vector<Product>& products) {
    for (auto column : numbers.colwise()) {
        const double middle = 0.5 * (column.minCoeff() + column.maxCoeff());
        const double half = 0.5 * (column.maxCoeff() - column.minCoeff());
        column = (column.array() - middle) / (half > 0 ? half : 1);
    }
    Eigen::MatrixXd rest = columns_of(numbers, products);
    std::vector<bool> determined;
    constexpr double rounding = 1e-8;
    for (Eigen::Index t = 0; t < rest.cols(); ++t) {
        const double size = rest.col(t).norm();
        // Twice is enough: Kahan, in Parlett (1980).
        for (int pass = 0; pass < 2; ++pass)
            for (Eigen::Index k = 0; k < t; ++k)
                if (determined[static_cast<std::size_t>(k)]) rest.col(t) -= rest.col(k).dot(rest.col(t)) * rest.col(k);
        const double left = rest.col(t).norm();
        determined.push_back(left > rounding * size);
        if (determined.back()) rest.col(t) /= left;
    }
    return determined;
}

} // namespace

Moments moments_of(const std::vector<double>& numbers, const std::vector<double>& weights) {
    std::vector<std::pair<double, double>> sorted;
    double all = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!std::isnan(numbers[i])) sorted.emplace_back(numbers[i], weights[i]), all += weights[i];
    Moments m;
    m.count = sorted.size(), m.missing = numbers.size() - sorted.size();
    if (sorted.empty()) return m;
    std::ranges::sort(sorted);
    for (const auto& [number, weight] : sorted) m.mean += weight * number / all;
    for (const auto& [number, weight] : sorted) m.deviation += weight * (number - m.mean) * (number - m.mean) / all;
    // Random runs estimate the scatter from n - 1 of them; in a point estimate it is known.
    const bool estimated = std::ranges::any_of(weights, [](double weight) { return weight != 1; });
    const double n = static_cast<double>(sorted.size());
    m.deviation = std::isnan(m.deviation) || (!estimated && n < 2)
                      ? unknown
                      : std::sqrt(std::max(0.0, m.deviation) * (estimated ? 1 : n / (n - 1)));
    // The rule of a point estimate needs each of its runs.
    if (estimated && m.missing > 0) m.mean = m.deviation = unknown;
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
    double all = 0, hits = 0, missing = 0;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        all += weights[i];
        if (std::isnan(truths[i])) {
            ++p.missing, missing += weights[i];
            continue;
        }
        ++p.count;
        if (truths[i] != 0) ++p.hits, hits += weights[i];
        p.counts_truths = p.counts_truths && (truths[i] == 0 || truths[i] == 1);
    }
    if (p.count == 0 || !p.counts_truths) {
        p.value = p.least = p.most = unknown, p.has_interval = false;
        return p;
    }
    p.least = hits / all, p.most = (hits + missing) / all;
    p.value = p.missing == 0 ? p.least : unknown;
    p.has_interval = std::ranges::all_of(weights, [](double weight) { return weight == 1; });
    if (!p.has_interval) return p;
    // Runs without a value may all be false, or all be true.
    using Binomial = boost::math::binomial_distribution<double>;
    const auto n = static_cast<double>(truths.size()), k = static_cast<double>(p.hits),
               most = static_cast<double>(p.hits + p.missing);
    p.low = p.hits == 0 ? 0 : Binomial::find_lower_bound_on_p(n, k, 0.025);
    p.high = most == n ? 1 : Binomial::find_upper_bound_on_p(n, most, 0.025);
    return p;
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y,
                        const std::vector<double>& weights) {
    std::vector<double> xs, ys, ws;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isnan(x[i]) && !std::isnan(y[i]) && weights[i] > 0)
            xs.push_back(x[i]), ys.push_back(y[i]), ws.push_back(weights[i]);
    return varies(xs) && varies(ys) ? correlation(ranks_of(xs, ws), ranks_of(ys, ws), ws) : unknown;
}

std::vector<Bar> tornado_of(const Study& study, const std::vector<Case>& cases, const std::vector<Outcome>& outcomes) {
    std::vector<Bar> bars;
    if (study.design.method == Design::Method::one_at_a_time) {
        bars = bars_one_at_a_time(study, cases, outcomes);
    } else {
        std::vector<double> results, weights;
        for (const auto& outcome : outcomes) results.push_back(known_number(outcome, study.tornado_of));
        for (const auto& one : cases) weights.push_back(one.weight);
        for (const std::size_t j : numeric_columns(cases)) {
            std::vector<double> numbers;
            for (const auto& one : cases) numbers.push_back(number_of(one.values[j].second));
            bars.push_back({cases[0].values[j].first, 0, rank_correlation(numbers, results, weights), "", ""});
        }
    }
    std::ranges::stable_sort(
        bars, [](const Bar& a, const Bar& b) { return a.is_known() && (!b.is_known() || a.length() > b.length()); });
    return bars;
}

std::optional<Response> response_of(const std::string& result, const std::vector<Case>& cases,
                                    const std::vector<Outcome>& outcomes) {
    const auto columns = numeric_columns(cases);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (std::isfinite(known_number(outcomes[i], result))) rows.push_back(i);
    const std::size_t n = columns.size(), terms = 1 + n + n * (n + 1) / 2;
    if (n == 0 || rows.size() < terms) return std::nullopt;
    Eigen::MatrixXd numbers(rows.size(), n);
    Eigen::VectorXd right(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        right(row) = known_number(outcomes[rows[i]], result);
        for (std::size_t j = 0; j < n; ++j)
            numbers(row, static_cast<Eigen::Index>(j)) = number_of(cases[rows[i]].values[columns[j]].second);
    }
    const std::vector<Product> all = products_of(n);
    const std::vector<bool> determined = determined_by(numbers, all);
    Response response;
    std::vector<Product> products;
    const auto name = [&](std::size_t j) { return cases[0].values[columns[j]].first; };
    for (std::size_t t = 0; t < all.size(); ++t) {
        const auto [one, other] = all[t];
        const std::string text = one == n       ? "1"
                                 : other == n   ? name(one)
                                 : one == other ? name(one) + "^2"
                                                : name(one) + " " + name(other);
        if (determined[t]) products.push_back(all[t]), response.terms.push_back({text, 0});
        else response.undetermined.push_back(text);
    }
    const Eigen::MatrixXd matrix = columns_of(numbers, products);
    // Scales columns to one size: a modulus in Pa is next to a friction angle.
    const Eigen::VectorXd scale = matrix.colwise().norm().cwiseMax(1e-300);
    const Eigen::VectorXd solution = (matrix * scale.cwiseInverse().asDiagonal())
                                         .completeOrthogonalDecomposition()
                                         .solve(right)
                                         .cwiseQuotient(scale);
    for (std::size_t t = 0; t < products.size(); ++t) response.terms[t].factor = solution(static_cast<Eigen::Index>(t));
    // As many terms as runs go through all runs, whatever the result is.
    if (products.size() == rows.size() || (right.array() == right(0)).all()) response.determination = unknown;
    else
        response.determination =
            1 - (matrix * solution - right).squaredNorm() / (right.array() - right.mean()).matrix().squaredNorm();
    return response;
}

} // namespace kaya
