#include "jointtest/curve_fit.hpp"

#include "base/diagnostic.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace kaya {

namespace {

/// A property between its limits as a free number, after MINUIT: a sine between two limits, a hyperbola beside one.
class FreeNumber {
public:
    FreeNumber(const JointModel::Property& p, double start)
        : low_(p.minimum), high_(p.maximum), scale_(std::abs(start) > 0 ? std::abs(start) : 1) {}

    double value(double t) const {
        if (std::isfinite(low_) && std::isfinite(high_)) return low_ + 0.5 * (high_ - low_) * (std::sin(t) + 1);
        if (std::isfinite(low_)) return low_ + scale_ * (std::sqrt(t * t + 1) - 1);
        if (std::isfinite(high_)) return high_ - scale_ * (std::sqrt(t * t + 1) - 1);
        return scale_ * t;
    }

    double number(double value) const {
        if (std::isfinite(low_) && std::isfinite(high_)) return std::asin(2 * (value - low_) / (high_ - low_) - 1);
        const auto root = [&](double above) { return std::sqrt(std::max(0.0, (above + 1) * (above + 1) - 1)); };
        if (std::isfinite(low_)) return root((value - low_) / scale_);
        if (std::isfinite(high_)) return root((high_ - value) / scale_);
        return value / scale_;
    }

private:
    double low_, high_, scale_;
};

/// One measured column: its values at the points of the path.
struct Measured {
    std::vector<double> values;
    double (*of)(const CurvePoint&);
    bool from_start; ///< counted from the first point, as a laboratory does
    double scale;
};

std::vector<Measured> measured_of(const LoadPath& path) {
    struct Known {
        const char* name;
        double (*of)(const CurvePoint&);
        bool given_by_path, from_start;
    };
    const bool by_stress = path.points.front().stress.has_value();
    const Known known[] = {
        {"shear_stress", [](const CurvePoint& p) { return p.resistance[0]; }, false, false},
        {"shear_stress_y", [](const CurvePoint& p) { return p.resistance[1]; }, false, false},
        {"opening", [](const CurvePoint& p) { return p.opening; }, !by_stress, true},
        {"measured_normal_stress", [](const CurvePoint& p) { return p.normal_stress; }, false, false},
    };
    std::vector<Measured> all;
    for (const auto& k : known) {
        const auto column = path.table.find(k.name);
        if (!column || k.given_by_path) continue;
        auto values = path.table.columns[*column];
        const double start = k.from_start ? values.front() : 0;
        double largest = 0;
        for (double& v : values) largest = std::max(largest, std::abs(v -= start));
        if (largest > 0) all.push_back({std::move(values), k.of, k.from_start, largest});
    }
    if (all.empty())
        throw Diagnostic("the file has no measured column",
                         "add shear_stress, opening (for a path of normal_stress) or measured_normal_stress");
    return all;
}

/// Residuals over free numbers, in the form that Eigen's minimiser asks for.
struct Residuals {
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    const JointModel& model;
    const LoadPath& path;
    CurveSettings settings;
    std::vector<Measured> measured;
    std::vector<double> base;
    std::vector<std::size_t> which;
    std::vector<FreeNumber> free;

    int inputs() const { return static_cast<int>(which.size()); }
    int values() const { return static_cast<int>(measured.size() * path.points.size()); }

    std::vector<double> values_at(const Eigen::VectorXd& t) const {
        auto values = base;
        for (std::size_t k = 0; k < which.size(); ++k) values[which[k]] = free[k].value(t[static_cast<Eigen::Index>(k)]);
        return values;
    }

    int operator()(const Eigen::VectorXd& t, Eigen::VectorXd& residuals) const {
        const auto values_here = values_at(t);
        if (!model.check(values_here).empty()) {
            residuals.setConstant(1e3); // values that cannot work together are far from any curve
            return 0;
        }
        const JointCurve curve = follow_path(model, values_here, path, settings);
        Eigen::Index row = 0;
        for (const auto& m : measured) {
            const double start = m.from_start ? m.of(curve.points.front()) : 0;
            for (std::size_t i = 0; i < curve.at_path.size(); ++i)
                residuals[row++] = (m.of(curve.points[curve.at_path[i]]) - start - m.values[i]) / m.scale;
        }
        return 0;
    }
};

double misfit_of(const Residuals& residuals, const Eigen::VectorXd& t) {
    Eigen::VectorXd r(residuals.values());
    residuals(t, r);
    return std::sqrt(r.squaredNorm() / static_cast<double>(r.size()));
}

std::size_t property_of(const JointModel& model, const std::string& name) {
    if (const auto index = model.find_property(name)) return *index;
    std::vector<std::string> names;
    for (const auto& p : model.properties) names.push_back(p.name);
    throw Diagnostic(fmt::format("joint model {} has no property '{}'", model.name, name),
                     fmt::format("its properties: {}", fmt::join(names, ", ")));
}

} // namespace

CurveFit fit_curve(const JointModel& model, const std::vector<double>& values, const std::vector<std::string>& names,
                   const LoadPath& path, const CurveSettings& settings) {
    Residuals residuals{model, path, settings, measured_of(path), values, {}, {}};
    residuals.settings.tangents = false;
    if (names.empty()) throw Diagnostic("there is nothing to fit", "name the properties: --fit friction,cohesion");
    Eigen::VectorXd t(static_cast<Eigen::Index>(names.size()));
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::size_t index = property_of(model, names[k]);
        const auto& p = model.properties[index];
        const double start = values[index];
        if (std::isnan(start))
            throw Diagnostic(fmt::format("'{}' has no value to start from", p.name), fmt::format("give a guess: {}=1", p.name));
        // On a limit the free number would have no slope.
        const double width = std::isfinite(p.maximum - p.minimum) ? p.maximum - p.minimum : std::max(std::abs(start), 1.0);
        const double inside = std::clamp(start, p.minimum + 1e-3 * width, p.maximum - 1e-3 * width);
        residuals.which.push_back(index);
        residuals.free.emplace_back(p, inside);
        t[static_cast<Eigen::Index>(k)] = residuals.free.back().number(inside);
    }
    if (residuals.values() < residuals.inputs())
        throw Diagnostic(fmt::format("{} properties cannot be found from {} measured values", residuals.inputs(),
                                     residuals.values()),
                         "fit fewer properties");
    CurveFit fit;
    fit.misfit_before = misfit_of(residuals, t);

    // Joints have kinks: the derivative is taken over a ten-thousandth of each number.
    constexpr double step = 1e-8; // its square root is used
    Eigen::NumericalDiff<Residuals, Eigen::Central> derivative(residuals, step);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals, Eigen::Central>> minimiser(derivative);
    minimiser.parameters.maxfev = 400;
    minimiser.parameters.ftol = minimiser.parameters.xtol = 1e-10;
    minimiser.minimize(t);

    fit.values = residuals.values_at(t);
    fit.misfit = misfit_of(residuals, t);
    fit.curve = follow_path(model, fit.values, path, settings);

    // Standard errors: variance of the residuals times the inverse of J^T J, taken over to the properties.
    Eigen::MatrixXd jacobian(residuals.values(), residuals.inputs());
    derivative.df(t, jacobian);
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(normal);
    const int freedom = residuals.values() - residuals.inputs();
    for (std::size_t k = 0; k < names.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        double deviation = std::numeric_limits<double>::quiet_NaN();
        if (lu.isInvertible() && freedom > 0) {
            const double variance = fit.misfit * fit.misfit * residuals.values() / freedom * lu.inverse()(i, i);
            const double slope = (residuals.free[k].value(t[i] + 1e-6) - residuals.free[k].value(t[i] - 1e-6)) / 2e-6;
            deviation = std::abs(slope) * std::sqrt(std::max(0.0, variance));
        }
        fit.properties.push_back({model.properties[residuals.which[k]].name, fit.values[residuals.which[k]], deviation});
    }
    return fit;
}

} // namespace kaya
