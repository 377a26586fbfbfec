#include "study/search.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <nlopt.hpp>

namespace kaya {

namespace {

constexpr double derivative_step = 1e-2; ///< as a fraction of the bounds: results of a run scatter by its tolerance
constexpr double near_bound = 1e-6;

constexpr double wide =
    5; ///< parameters with a larger ratio of bounds are searched by their logarithm: of a stiffness the power of ten is known
constexpr int most_polishes = 3;

/// Parameters are scaled to 0 to 1 here: NLopt's methods need similar ranges.
class Fitting {
public:
    Fitting(const Study& study, Runs& runs, FitAnswer& answer)
        : fit_(*study.fit), study_(study), runs_(runs), answer_(answer) {}

    std::vector<Outcome> at(const std::vector<std::vector<double>>& points) {
        std::vector<Case> cases;
        for (const auto& point : points) {
            Case one;
            one.number = answer_.cases.size() + cases.size() + 1;
            for (std::size_t j = 0; j < point.size(); ++j)
                one.values.emplace_back(fit_.unknowns[j].parameter, value(point, j));
            one.values.insert(one.values.end(), study_.fixed.begin(), study_.fixed.end());
            cases.push_back(std::move(one));
        }
        const auto outcomes = runs_.all(cases);
        answer_.cases.insert(answer_.cases.end(), cases.begin(), cases.end());
        answer_.outcomes.insert(answer_.outcomes.end(), outcomes.begin(), outcomes.end());
        return outcomes;
    }

    static bool is_wide(const Fit::Unknown& unknown) { return unknown.from > 0 && unknown.to > wide * unknown.from; }

    double value(const std::vector<double>& point, std::size_t j) const {
        const auto& unknown = fit_.unknowns[j];
        if (is_wide(unknown))
            return std::clamp(unknown.from * std::pow(unknown.to / unknown.from, point[j]), unknown.from, unknown.to);
        return unknown.from + point[j] * (unknown.to - unknown.from);
    }
    static double coordinate(const Fit::Unknown& unknown, double value) {
        if (is_wide(unknown)) return std::log(value / unknown.from) / std::log(unknown.to / unknown.from);
        return (value - unknown.from) / (unknown.to - unknown.from);
    }
    /// Derivative of the value with respect to its coordinate.
    double rate(const std::vector<double>& point, std::size_t j) const {
        const auto& unknown = fit_.unknowns[j];
        return is_wide(unknown) ? value(point, j) * std::log(unknown.to / unknown.from) : unknown.to - unknown.from;
    }

    /// Differences to the measurements, in deviations where they are known; a row of NaN when the run has no results.
    Eigen::VectorXd differences(const Outcome& outcome) const {
        Eigen::VectorXd rows(static_cast<Eigen::Index>(fit_.observations.size()));
        for (std::size_t i = 0; i < fit_.observations.size(); ++i) {
            const auto& seen = fit_.observations[i];
            rows(static_cast<Eigen::Index>(i)) = (known_number(outcome, seen.result) - seen.value) / scale(seen);
        }
        return rows;
    }

    /// Without a deviation the difference is relative to the observation, which is not 0.
    static double scale(const Fit::Observation& seen) {
        return seen.deviation > 0 ? seen.deviation : std::abs(seen.value);
    }

    /// The sum of squares; for a failed run more than any before.
    double objective(const std::vector<double>& point) {
        const auto outcomes = at({point});
        const double sum = differences(outcomes[0]).squaredNorm();
        if (std::isfinite(sum)) {
            worst_ = std::max(worst_, sum);
            if (sum < best_) best_ = sum, best_point_ = point, best_run_ = answer_.outcomes.size() - 1;
            return sum;
        }
        if (best_point_.empty())
            throw Diagnostic(fmt::format("the run at the start has no results: {}", outcomes[0].message),
                             "choose another 'start'", Fault::run)
                .at(fit_.place);
        return 10 * worst_ + 1;
    }

    void search() {
        nlopt::algorithm method = nlopt::LN_BOBYQA;
        if (fit_.method == "cobyla") method = nlopt::LN_COBYLA;
        if (fit_.method == "sbplx" || (method == nlopt::LN_BOBYQA && fit_.unknowns.size() < 2))
            method = nlopt::LN_SBPLX; // BOBYQA needs two
        nlopt::opt optimiser(method, static_cast<unsigned>(fit_.unknowns.size()));
        optimiser.set_lower_bounds(0.0);
        optimiser.set_upper_bounds(1.0);
        optimiser.set_initial_step(0.1);
        optimiser.set_xtol_abs(fit_.tolerance);
        optimiser.set_ftol_abs(1e-12);
        optimiser.set_maxeval(static_cast<int>(fit_.most_runs));
        optimiser.set_min_objective(
            [](const std::vector<double>& point, std::vector<double>&, void* self) {
                auto& fitting = *static_cast<Fitting*>(self);
                try {
                    return fitting.objective(point);
                } catch (...) { // C is between: the exception is rethrown after NLopt
                    fitting.thrown_ = std::current_exception();
                    throw nlopt::forced_stop();
                }
            },
            this);
        std::vector<double> point;
        for (const auto& unknown : fit_.unknowns) point.push_back(coordinate(unknown, unknown.start));
        double least = 0;
        nlopt::result ended = nlopt::SUCCESS;
        try {
            ended = optimiser.optimize(point, least);
        } catch (const nlopt::forced_stop&) {
            if (thrown_) std::rethrow_exception(thrown_);
        } catch (const nlopt::roundoff_limited&) { // limit of the precision of numbers
        }
        answer_.converged = ended != nlopt::MAXEVAL_REACHED;
    }

    /// Derivatives of the differences at the best point, from runs on both sides of it.
    Eigen::MatrixXd slopes() {
        std::vector<std::vector<double>> points;
        std::vector<double> widths;
        for (std::size_t j = 0; j < fit_.unknowns.size(); ++j) {
            auto less = best_point_, more = best_point_;
            less[j] = std::max(0.0, less[j] - derivative_step), more[j] = std::min(1.0, more[j] + derivative_step);
            widths.push_back(more[j] - less[j]);
            points.push_back(std::move(less)), points.push_back(std::move(more));
        }
        const auto outcomes = at(points);
        Eigen::MatrixXd result(static_cast<Eigen::Index>(fit_.observations.size()),
                               static_cast<Eigen::Index>(points.size() / 2));
        for (std::size_t j = 0; j < widths.size(); ++j)
            result.col(static_cast<Eigen::Index>(j)) =
                (differences(outcomes[2 * j + 1]) - differences(outcomes[2 * j])) / widths[j];
        return result;
    }

    /// Gauss-Newton steps from the end point of NLopt, which does not use that the objective is a sum of squares. Returns the derivatives
    /// at the end.
    Eigen::MatrixXd polish() {
        Eigen::MatrixXd derivatives = slopes();
        for (int step = 0; step < most_polishes; ++step) {
            const Eigen::VectorXd rest = differences(answer_.outcomes[best_run_]);
            if (!derivatives.allFinite() || !rest.allFinite()) break;
            const Eigen::VectorXd move = derivatives.completeOrthogonalDecomposition().solve(-rest);
            if (move.cwiseAbs().maxCoeff() < 0.1 * fit_.tolerance) break;
            std::vector<double> point = best_point_;
            for (std::size_t j = 0; j < point.size(); ++j)
                point[j] = std::clamp(point[j] + move(static_cast<Eigen::Index>(j)), 0.0, 1.0);
            const double before = best_;
            if (point == best_point_ || !(objective(point) < before)) break;
            derivatives = slopes();
        }
        return derivatives;
    }

    void uncertainty(const Eigen::MatrixXd& derivatives) {
        const std::size_t n = fit_.unknowns.size(), m = fit_.observations.size();
        const bool measured =
            std::ranges::all_of(fit_.observations, [](const auto& seen) { return seen.deviation > 0; });
        const double variance = measured ? 1 : m > n ? best_ / static_cast<double>(m - n) : std::nan("");
        const Eigen::MatrixXd normal = derivatives.transpose() * derivatives;
        const Eigen::FullPivLU<Eigen::MatrixXd> factored(normal);
        const bool told = normal.allFinite() && factored.isInvertible();
        const Eigen::MatrixXd covariance = told ? Eigen::MatrixXd(factored.inverse() * variance)
                                                : Eigen::MatrixXd::Constant(normal.rows(), normal.cols(), std::nan(""));
        for (std::size_t j = 0; j < n; ++j) {
            const auto jj = static_cast<Eigen::Index>(j);
            answer_.found.push_back({fit_.unknowns[j].parameter, value(best_point_, j),
                                     rate(best_point_, j) * std::sqrt(covariance(jj, jj)),
                                     best_point_[j] < near_bound || best_point_[j] > 1 - near_bound});
            answer_.correlation.emplace_back();
            for (Eigen::Index k = 0; k < covariance.cols(); ++k)
                answer_.correlation.back().push_back(covariance(jj, k) /
                                                     std::sqrt(covariance(jj, jj) * covariance(k, k)));
        }
        for (const auto& seen : fit_.observations)
            answer_.compared.push_back({seen.result, seen.value,
                                        number_of(result_of(answer_.outcomes[best_run_], seen.result)),
                                        seen.deviation});
    }

private:
    const Fit& fit_;
    const Study& study_;
    Runs& runs_;
    FitAnswer& answer_;
    double best_ = std::numeric_limits<double>::infinity(), worst_ = 0;
    std::vector<double> best_point_;
    std::size_t best_run_ = 0;
    std::exception_ptr thrown_;
};

} // namespace

FitAnswer fit_parameters(const Study& study, Runs& runs) {
    FitAnswer answer;
    Fitting fitting(study, runs, answer);
    fitting.search();
    fitting.uncertainty(fitting.polish());
    return answer;
}

} // namespace kaya
