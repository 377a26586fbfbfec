#include "study/design.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <random>

namespace kaya {

namespace {

constexpr std::size_t most_runs = 10'000'000;
constexpr std::size_t most_estimated = 20; ///< parameters of a point estimate: two points each

using Table = Eigen::MatrixXd; ///< a row for each run, a column for each parameter

/// A number between 0 and 1, both excluded. The distributions of the standard library differ between implementations.
double part(std::mt19937_64& generator) { return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53; }

std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& generator) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[generator() % i]);
    return order;
}

/// The lower triangle L with L Lᵀ = correlations.
Table triangle_of(const Study& study) {
    const auto n = static_cast<Eigen::Index>(study.factors.size());
    Table correlation = Table::Identity(n, n);
    for (const auto& c : study.design.correlations) {
        const auto i = static_cast<Eigen::Index>(c.one), j = static_cast<Eigen::Index>(c.other);
        correlation(i, j) = correlation(j, i) = c.value;
    }
    const Eigen::LLT<Table> factored(correlation);
    if (factored.info() != Eigen::Success || factored.matrixL().toDenseMatrix().diagonal().minCoeff() < 1e-6)
        throw Diagnostic("these correlations cannot hold together: their matrix is not positive definite",
                         "if a goes with b and b with c, a goes with c as well")
            .at(study.factors[study.design.correlations.back().one].place);
    return factored.matrixL();
}

/// Fractions between 0 and 1, one in each of `samples` equal strata.
Table latin_parts(std::size_t samples, std::size_t columns, std::mt19937_64& generator) {
    Table parts(samples, columns);
    for (std::size_t j = 0; j < columns; ++j) {
        const auto order = shuffled(samples, generator);
        for (std::size_t i = 0; i < samples; ++i)
            parts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                (static_cast<double>(order[i]) + part(generator)) / static_cast<double>(samples);
    }
    return parts;
}

/// Gives the numbers of each column the order of those of `like`.
void reorder(Table& numbers, const Table& like) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(like.rows()));
    for (Eigen::Index j = 0; j < like.cols(); ++j) {
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, [&](Eigen::Index a, Eigen::Index b) { return like(a, j) < like(b, j); });
        std::vector<double> sorted(numbers.col(j).begin(), numbers.col(j).end());
        std::ranges::sort(sorted);
        for (std::size_t i = 0; i < order.size(); ++i) numbers(order[i], j) = sorted[i];
    }
}

/// Iman and Conover: normal scores get the wanted correlation, and the samples the order of the scores. The random correlation of the
/// scores is removed first.
void correlate_ranks(Table& parts, const Table& triangle, std::mt19937_64& generator) {
    const Eigen::Index rows = parts.rows();
    Table scores(rows, parts.cols());
    for (Eigen::Index j = 0; j < parts.cols(); ++j) {
        const auto order = shuffled(static_cast<std::size_t>(rows), generator);
        for (Eigen::Index i = 0; i < rows; ++i)
            scores(i, j) = normal_quantile((static_cast<double>(order[static_cast<std::size_t>(i)]) + 0.5) /
                                           static_cast<double>(rows));
    }
    const Table own = scores.transpose() * scores / static_cast<double>(rows);
    const Eigen::LLT<Table> factored(own);
    if (rows > parts.cols() && factored.info() == Eigen::Success)
        scores = factored.matrixL().solve(scores.transpose()).transpose().eval();
    reorder(parts, scores * triangle.transpose());
}

/// A Gaussian copula: normal numbers with the wanted correlation, as fractions.
void correlate_normal(Table& parts, const Table& triangle) {
    for (Eigen::Index i = 0; i < parts.rows(); ++i) {
        Eigen::VectorXd normal(parts.cols());
        for (Eigen::Index j = 0; j < parts.cols(); ++j) normal(j) = normal_quantile(parts(i, j));
        normal = triangle * normal;
        for (Eigen::Index j = 0; j < parts.cols(); ++j)
            parts(i, j) = std::clamp(normal_part(normal(j)), 1e-300, 1 - 1e-16);
    }
}

Table sobol_parts(std::size_t samples, std::size_t columns, std::mt19937_64& generator) {
    boost::random::sobol sequence(columns);
    Table parts(samples, columns);
    // A shift by chance, modulo 1 (Cranley and Patterson 1976): another seed gives other points, evenly spread as well.
    std::vector<double> shift(columns);
    for (auto& s : shift) s = part(generator);
    const double range = static_cast<double>(boost::random::sobol::max()) + 1;
    for (std::size_t i = 0; i < samples; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            const double moved = (static_cast<double>(sequence()) + 0.5) / range + shift[j];
            parts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                std::clamp(moved - std::floor(moved), 1e-15, 1 - 1e-15);
        }
    return parts;
}

std::vector<Case> sampled(const Study& study) {
    const std::size_t samples = study.design.samples, columns = study.factors.size();
    std::mt19937_64 generator(study.design.seed);
    Table parts;
    if (study.design.method == Design::Method::latin_hypercube) {
        parts = latin_parts(samples, columns, generator);
        if (!study.design.correlations.empty()) correlate_ranks(parts, triangle_of(study), generator);
    } else {
        if (study.design.method == Design::Method::sobol) {
            parts = sobol_parts(samples, columns, generator);
        } else {
            parts.resize(static_cast<Eigen::Index>(samples), static_cast<Eigen::Index>(columns));
            for (Eigen::Index i = 0; i < parts.rows(); ++i)
                for (Eigen::Index j = 0; j < parts.cols(); ++j) parts(i, j) = part(generator);
        }
        if (!study.design.correlations.empty()) correlate_normal(parts, triangle_of(study));
    }
    std::vector<Case> cases(samples);
    for (std::size_t i = 0; i < samples; ++i)
        for (std::size_t j = 0; j < columns; ++j)
            cases[i].values.emplace_back(study.factors[j].name,
                                         study.factors[j].distribution->quantile(
                                             parts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    return cases;
}

/// Mean minus and plus a deviation, both within the range of the distribution.
std::array<double, 2> two_points(const Factor& factor) {
    const auto& d = *factor.distribution;
    const double mean = d.mean(), deviation = d.deviation();
    const auto [low, high] = d.range();
    const double rounding = 1e-9 * deviation;
    std::array<double, 2> points{mean - deviation, mean + deviation};
    for (double& point : points) {
        if (point < low - rounding || point > high + rounding)
            throw Diagnostic(
                fmt::format("a point estimate takes '{}' at its mean {:g} {} one deviation of {:g}, which is {:g}, and "
                            "its distribution lies {} {:g}",
                            factor.name, mean, point < low ? "less" : "plus", deviation, point,
                            point < low ? "above" : "below", point < low ? low : high),
                "use method = \"latin-hypercube\" with samples = 200, or give a smaller deviation")
                .at(factor.place);
        point = std::clamp(point, low, high);
    }
    return points;
}

/// Rosenblueth's weights are probabilities only when none is negative.
void check_weights(const Study& study, const std::vector<Case>& cases) {
    const auto negative = std::ranges::count_if(cases, [](const Case& one) { return one.weight < 0; });
    if (negative == 0) return;
    throw Diagnostic(fmt::format("with these correlations {} of the {} runs of a point estimate have negative weights, "
                                 "which are not probabilities",
                                 negative, cases.size()),
                     "use method = \"latin-hypercube\" with samples = 200, or weaker correlations")
        .at(study.factors[study.design.correlations.back().one].place);
}

/// Rosenblueth's two points of each parameter, mean plus and minus a deviation. The weight of a corner is
/// (1 + sum over pairs of correlation times both signs) / 2^n.
std::vector<Case> point_estimate(const Study& study) {
    const std::size_t n = study.factors.size();
    if (n > most_estimated)
        throw Diagnostic(fmt::format("a point estimate of {} parameters takes 2^{} runs", n, n),
                         "use a Latin hypercube", Fault::deck)
            .at(study.factors.back().place);
    if (!study.design.correlations.empty()) triangle_of(study);
    std::vector<std::array<double, 2>> points;
    for (const auto& factor : study.factors) points.push_back(two_points(factor));
    std::vector<Case> cases;
    for (std::size_t corner = 0; corner < (std::size_t{1} << n); ++corner) {
        const auto side = [&](std::size_t j) { return (corner >> j) & 1; };
        const auto sign = [&](std::size_t j) { return side(j) == 1 ? 1.0 : -1.0; };
        Case one;
        for (std::size_t j = 0; j < n; ++j) one.values.emplace_back(study.factors[j].name, points[j][side(j)]);
        double weight = 1;
        for (const auto& c : study.design.correlations) weight += c.value * sign(c.one) * sign(c.other);
        constexpr double rounding = 1e-12;
        if (std::abs(weight) < rounding) weight = 0;
        one.weight = weight / static_cast<double>(std::size_t{1} << n);
        cases.push_back(std::move(one));
    }
    check_weights(study, cases);
    return cases;
}

std::vector<Case> grid(const Study& study) {
    std::size_t count = 1;
    for (const auto& factor : study.factors) {
        count *= factor.values.size();
        if (count > most_runs)
            throw Diagnostic(fmt::format("this grid has more than {} runs", most_runs),
                             "take fewer values, or a Latin hypercube")
                .at(factor.place);
    }
    std::vector<Case> cases(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t left = i;
        for (std::size_t j = study.factors.size(); j-- > 0;) {
            const auto& factor = study.factors[j];
            cases[i].values.emplace_back(factor.name, factor.values[left % factor.values.size()]);
            left /= factor.values.size();
        }
        std::ranges::reverse(cases[i].values);
    }
    return cases;
}

std::vector<Case> list(const Study& study) {
    std::vector<Case> cases(study.factors.front().values.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
        for (const auto& factor : study.factors) cases[i].values.emplace_back(factor.name, factor.values[i]);
    return cases;
}

/// The base, and each value of each parameter with the other parameters at their base.
std::vector<Case> one_at_a_time(const Study& study) {
    Case base;
    for (const auto& factor : study.factors) base.values.emplace_back(factor.name, *factor.base);
    std::vector<Case> cases{base};
    for (std::size_t j = 0; j < study.factors.size(); ++j)
        for (const auto& value : study.factors[j].values) {
            if (value == *study.factors[j].base) continue;
            cases.push_back(base);
            cases.back().values[j].second = value;
        }
    return cases;
}

} // namespace

std::vector<Case> cases_of(const Study& study) {
    if (study.critical || study.fit) return {};
    std::vector<Case> cases;
    switch (study.design.method) {
    case Design::Method::grid: cases = grid(study); break;
    case Design::Method::list: cases = list(study); break;
    case Design::Method::one_at_a_time: cases = one_at_a_time(study); break;
    case Design::Method::point_estimate: cases = point_estimate(study); break;
    case Design::Method::latin_hypercube:
    case Design::Method::sobol:
    case Design::Method::random: cases = sampled(study); break;
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i].number = i + 1;
        cases[i].values.insert(cases[i].values.end(), study.fixed.begin(), study.fixed.end());
    }
    return cases;
}

} // namespace kaya
