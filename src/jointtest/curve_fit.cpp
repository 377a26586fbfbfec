#include "jointtest/curve_fit.hpp"

#include "base/diagnostic.hpp"
#include "jointtest/fit_residuals.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>

namespace kaya {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct Minimum {
    Eigen::VectorXd t;
    double squares;
    bool converged;
};

Minimum go_down(Residuals& residuals, Eigen::VectorXd t, double tolerance) {
    Eigen::LevenbergMarquardt<Residuals> minimiser(residuals);
    minimiser.parameters.maxfev = 600;
    minimiser.parameters.ftol = minimiser.parameters.xtol = tolerance;
    const auto status = minimiser.minimize(t);
    using namespace Eigen::LevenbergMarquardtSpace;
    return {t, residuals.sum_of_squares(t), status != TooManyFunctionEvaluation && status != ImproperInputParameters};
}

/// Evenly spread numbers between 0 and 1, the same in every run (Halton).
double halton(std::size_t index, std::size_t dimension) {
    constexpr std::size_t primes[] = {2, 3, 5, 7, 11, 13, 17, 19};
    const std::size_t prime = primes[dimension % std::size(primes)];
    double part = 1, sum = 0;
    for (; index > 0; index /= prime) sum += (part /= static_cast<double>(prime)) * static_cast<double>(index % prime);
    return sum;
}

/// Starting points: the given values, and the best of many others.
std::vector<Eigen::VectorXd> places_to_start(const Residuals& residuals, const Eigen::VectorXd& given,
                                             std::size_t most) {
    constexpr std::size_t candidates = 40;
    std::vector<std::pair<double, Eigen::VectorXd>> tried;
    Eigen::VectorXd r(residuals.values());
    for (std::size_t c = 1; most > 1 && c <= candidates; ++c) {
        Eigen::VectorXd t = given;
        for (std::size_t k = 0; k < residuals.free.size(); ++k)
            t[static_cast<Eigen::Index>(k)] = residuals.free[k].number(residuals.free[k].spread(halton(c, k)));
        if (residuals.evaluate(t, r)) tried.emplace_back(r.squaredNorm(), t);
    }
    std::stable_sort(tried.begin(), tried.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Eigen::VectorXd> places{given};
    for (std::size_t k = 0; k < tried.size() && places.size() < most; ++k) places.push_back(tried[k].second);
    return places;
}

/// Minimises from all starting points; returns the lowest minimum and how many reached it.
Minimum search(Residuals& residuals, const Eigen::VectorXd& given, std::size_t most, FitSearch& said) {
    std::vector<Minimum> found;
    for (const auto& t : places_to_start(residuals, given, most)) found.push_back(go_down(residuals, t, 1e-6));
    const auto best = *std::min_element(found.begin(), found.end(),
                                        [](const Minimum& a, const Minimum& b) { return a.squares < b.squares; });
    // A thousandth of the sum is below noise; 1e-4 of the largest value is an exact fit.
    const double same = 1.001 * best.squares + 1e-8 * residuals.values();
    double next = std::numeric_limits<double>::infinity();
    said.starts = found.size();
    for (const auto& minimum : found)
        minimum.squares <= same ? void(++said.agreed) : void(next = std::min(next, minimum.squares));
    if (std::isfinite(next)) said.next_misfit = std::sqrt(next / residuals.values());
    said.first_was_false = found.front().squares > same;
    return best;
}

/// The residual of each column gives its weight; a column without noise must not dominate.
bool weigh_by_noise(Residuals& residuals, const Minimum& at) {
    const JointCurve curve =
        follow_path(residuals.model, residuals.values_at(at.t), residuals.path, residuals.settings);
    const double share = residuals.freedom() / static_cast<double>(residuals.values());
    bool changed = false;
    for (auto& m : residuals.measured) {
        double squares = 0;
        for (const double v : residuals.left_of(m, curve).values) squares += v * v;
        const double count = std::max(1.0, share * static_cast<double>(m.values.size()));
        const double scale = std::max(std::sqrt(squares / count), 1e-6 * m.largest);
        changed |= std::abs(scale / m.scale - 1) > 0.01;
        m.scale = scale;
    }
    return changed;
}

void settle_weights(Residuals& residuals, Minimum& minimum) {
    constexpr int most_rounds = 10;
    for (int round = 0; round < most_rounds && residuals.freedom() > 0 && weigh_by_noise(residuals, minimum); ++round)
        if (residuals.measured.size() > 1) minimum = go_down(residuals, minimum.t, 1e-10);
}

/// The search uses few steps along the path. The effect of many steps is a correction that hardly depends on the values: it is repeated
/// until it changes by less than a tenth of a standard error.
void correct_for_steps(Residuals& residuals, Minimum& minimum, const CurveSettings& many) {
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds && residuals.correct_steps(minimum.t, many) > 0.1; ++round) {
        minimum = go_down(residuals, minimum.t, 1e-10);
        settle_weights(residuals, minimum);
    }
}

/// Student's t for 95 %: the expansion in the degrees of freedom (Abramowitz and Stegun 26.7.5).
double student(int freedom) {
    const double z = 1.959964, n = freedom, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

/// Covariance of the free numbers: the inverse of J^T J with residuals in units of their noise. Numbers that do not affect the curve get
/// NaN: directions with a singular value below a millionth of the largest.
Eigen::MatrixXd covariance_of(const Residuals& residuals, const Eigen::VectorXd& t) {
    const Eigen::Index n = t.size();
    Eigen::MatrixXd jacobian(residuals.values(), n);
    residuals.df(t, jacobian);
    Eigen::VectorXd norms = jacobian.colwise().norm();
    const double largest = norms.maxCoeff();
    for (Eigen::Index k = 0; k < n; ++k) norms[k] = norms[k] > 1e-9 * largest ? norms[k] : largest > 0 ? largest : 1;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian * norms.cwiseInverse().asDiagonal(),
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd untold = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const double singular = svd.singularValues()[k];
        const Eigen::VectorXd direction = svd.matrixV().col(k);
        if (singular > 1e-6 * svd.singularValues()[0])
            covariance += direction * direction.transpose() / (singular * singular);
        else untold += direction.cwiseAbs2();
    }
    covariance = norms.cwiseInverse().asDiagonal() * covariance * norms.cwiseInverse().asDiagonal();
    for (Eigen::Index k = 0; k < n; ++k)
        if (untold[k] > 1e-4 || residuals.freedom() <= 0)
            covariance.row(k).setConstant(nothing), covariance.col(k).setConstant(nothing);
    return covariance;
}

void fill_properties(CurveFit& fit, const Residuals& residuals, const Minimum& minimum) {
    const Eigen::MatrixXd covariance = covariance_of(residuals, minimum.t);
    const double factor = residuals.freedom() > 0 ? student(residuals.freedom()) : nothing;
    std::vector<double> slopes;
    for (std::size_t k = 0; k < residuals.which.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double value = fit.values[residuals.which[k]];
        slopes.push_back(residuals.free[k].slope(minimum.t[i]));
        const double deviation = std::abs(slopes[k]) * std::sqrt(covariance(i, i));
        fit.properties.push_back({residuals.model.properties[residuals.which[k]].name, value, deviation,
                                  factor * deviation, residuals.free[k].at_limit(value)});
    }
    for (std::size_t a = 0; a < slopes.size(); ++a) {
        auto& row = fit.correlation.emplace_back();
        for (std::size_t b = 0; b < slopes.size(); ++b) {
            const auto i = static_cast<Eigen::Index>(a), j = static_cast<Eigen::Index>(b);
            const double sign = slopes[a] * slopes[b] < 0 ? -1 : 1;
            row.push_back(sign * covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)));
        }
    }
}

/// Whether values keep their sign longer than noise does: the runs test, at 3 1/3 deviations.
bool in_waves(const std::vector<double>& values, double negligible) {
    double above = 0, runs = 1, largest = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        largest = std::max(largest, std::abs(values[k]));
        above += values[k] > 0;
        runs += k > 0 && (values[k] > 0) != (values[k - 1] > 0);
    }
    const double n = static_cast<double>(values.size()), pairs = 2 * above * (n - above);
    if (n < 10 || largest < negligible) return false;
    if (pairs == 0) return true; // all on one side
    const double expected = pairs / n + 1, variance = pairs * (pairs - n) / (n * n * (n - 1));
    return runs < expected - 3.3 * std::sqrt(variance);
}

void fill_columns(CurveFit& fit, const Residuals& residuals) {
    double squares = 0;
    for (const auto& m : residuals.measured) {
        const auto left = residuals.left_of(m, fit.curve);
        double sum = 0;
        for (const double v : left.values) sum += v * v;
        squares += sum / (m.largest * m.largest);
        fit.columns.push_back({m.name, m.scale, m.largest, m.free_offset ? std::optional(left.offset) : std::nullopt,
                               in_waves(left.values, 1e-4 * m.largest)});
    }
    fit.misfit = std::sqrt(squares / residuals.values());
}

void judge(CurveFit& fit) {
    auto& search = fit.search;
    for (const auto& column : fit.columns)
        if (column.waves && column.noise > 0.1 * column.largest)
            search.doubt = fmt::format("{} is missed by {:.0f} % of its largest value, and not by noise: a "
                                       "false minimum, or a curve "
                                       "that this model cannot follow",
                                       column.name, 100 * column.noise / column.largest);
    if (search.starts >= 4 && search.agreed == 1)
        search.doubt =
            fmt::format("only one of {} starts leads here: there may be a better minimum; start nearer, or fit fewer "
                        "properties",
                        search.starts);
    if (!search.converged) search.doubt = "the search has not come to its end: fit fewer properties, or start nearer";
}

std::size_t property_of(const JointModel& model, const std::string& name) {
    if (const auto index = model.find_property(name)) return *index;
    std::vector<std::string_view> names;
    for (const auto& p : model.properties) {
        names.push_back(p.name);
        names.insert(names.end(), p.aliases.begin(), p.aliases.end());
    }
    const auto near = did_you_mean(name, names);
    throw Diagnostic(fmt::format("joint model {} has no property '{}'", model.name, name),
                     near.empty() ? fmt::format("its properties: {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean '{}'?", near));
}

/// Initial values; fills in the unknowns.
Eigen::VectorXd begin(Residuals& residuals, const std::vector<std::string>& names) {
    if (names.empty()) throw Diagnostic("there is nothing to fit", "name the properties: --fit friction,cohesion");
    Eigen::VectorXd t(static_cast<Eigen::Index>(names.size()));
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::size_t index = property_of(residuals.model, names[k]);
        const auto& p = residuals.model.properties[index];
        const double start = residuals.base[index];
        if (std::isnan(start))
            throw Diagnostic(fmt::format("'{}' has no value to start from", p.name),
                             fmt::format("give a guess: {}=1", p.name));
        if (std::find(residuals.which.begin(), residuals.which.end(), index) != residuals.which.end())
            throw Diagnostic(fmt::format("'{}' stands twice after --fit", p.name), "name each property once");
        // On a limit the free number would have no slope.
        const double width =
            std::isfinite(p.maximum - p.minimum) ? p.maximum - p.minimum : std::max(std::abs(start), 1.0);
        const double inside = std::clamp(start, p.minimum + 1e-3 * width, p.maximum - 1e-3 * width);
        residuals.which.push_back(index);
        residuals.free.emplace_back(p, inside);
        t[static_cast<Eigen::Index>(k)] = residuals.free.back().number(inside);
    }
    if (residuals.values() < residuals.inputs())
        throw Diagnostic(fmt::format("{} properties cannot be found from {} measured values", residuals.inputs(),
                                     residuals.values()),
                         "fit fewer properties");
    return t;
}

} // namespace

CurveFit fit_curve(const JointModel& model, const std::vector<double>& values, const std::vector<std::string>& names,
                   const LoadPath& path, const FitSettings& settings) {
    Residuals residuals{model, path, settings.curve, measured_of(path, settings.offsets), values, {}, {}};
    residuals.settings.tangents = false;
    const std::size_t pieces = path.points.size() - 1;
    CurveSettings many = settings.curve;
    many.tangents = false;
    if (many.steps == 0) {
        constexpr std::size_t few_along_path = 200, many_along_path = 4000;
        residuals.settings.steps = (few_along_path + pieces - 1) / pieces;
        many.steps = std::min<std::size_t>(1000, 2 * residuals.settings.steps + many_along_path / pieces);
        residuals.settings.steps_to_start = 20;
        many.steps_to_start = 200;
    }
    const Eigen::VectorXd given = begin(residuals, names);
    (void)SingleJoint(model, residuals.values_at(given),
                      settings.curve.area); // values that cannot be end here, with the reason
    CurveFit fit;
    fit.misfit_before = std::sqrt(residuals.sum_of_squares(given) / residuals.values());
    Minimum minimum = search(residuals, given, settings.starts, fit.search);
    if (residuals.measured.size() == 1 || residuals.freedom() <= 0) minimum = go_down(residuals, minimum.t, 1e-10);
    settle_weights(residuals, minimum);
    if (settings.curve.steps == 0) correct_for_steps(residuals, minimum, many);
    fit.search.converged = minimum.converged;
    fit.steps = many.steps;
    fit.values = residuals.values_at(minimum.t);
    fill_properties(fit, residuals, minimum);
    for (auto& m : residuals.measured) m.correction.clear(); // the last curve has all steps
    many.tangents = settings.curve.tangents;
    fit.curve = follow_path(model, fit.values, path, many);
    fill_columns(fit, residuals);
    judge(fit);
    return fit;
}

} // namespace kaya
