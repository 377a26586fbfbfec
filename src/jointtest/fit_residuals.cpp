#include "jointtest/fit_residuals.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace kaya {

FreeNumber::FreeNumber(const JointModel::Property& p, double start)
    : low_(p.minimum), high_(p.maximum), scale_(std::abs(start) > 0 ? std::abs(start) : 1) {}

double FreeNumber::value(double t) const {
    if (std::isfinite(low_) && std::isfinite(high_)) return low_ + 0.5 * (high_ - low_) * (std::sin(t) + 1);
    if (std::isfinite(low_)) return low_ + scale_ * (std::sqrt(t * t + 1) - 1);
    if (std::isfinite(high_)) return high_ - scale_ * (std::sqrt(t * t + 1) - 1);
    return scale_ * t;
}

double FreeNumber::number(double value) const {
    if (std::isfinite(low_) && std::isfinite(high_)) return std::asin(2 * (value - low_) / (high_ - low_) - 1);
    const auto root = [&](double above) { return std::sqrt(std::max(0.0, (above + 1) * (above + 1) - 1)); };
    if (std::isfinite(low_)) return root((value - low_) / scale_);
    if (std::isfinite(high_)) return root((high_ - value) / scale_);
    return value / scale_;
}

double FreeNumber::spread(double part) const {
    if (std::isfinite(low_) && std::isfinite(high_)) return low_ + part * (high_ - low_);
    const double factor = std::pow(4.0, 2 * part - 1);
    if (std::isfinite(low_)) return low_ + factor * scale_;
    if (std::isfinite(high_)) return high_ - factor * scale_;
    return scale_ * (4 * part - 2);
}

bool FreeNumber::at_limit(double value) const {
    const double near = 1e-3 * (std::isfinite(high_ - low_) ? high_ - low_ : scale_);
    return value - low_ < near || high_ - value < near;
}

namespace {

struct Known {
    const char* name;
    double (*of)(const CurvePoint&);
    bool given_by_path;
};

std::vector<Known> known_columns(bool by_stress) {
    return {
        {"shear_stress", [](const CurvePoint& p) { return p.resistance[0]; }, false},
        {"shear_stress_y", [](const CurvePoint& p) { return p.resistance[1]; }, false},
        {"opening", [](const CurvePoint& p) { return p.opening; }, !by_stress},
        {"measured_normal_stress", [](const CurvePoint& p) { return p.normal_stress; }, by_stress},
    };
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

bool is_measured_column(const std::string& name) {
    const auto known = known_columns(true);
    return std::any_of(known.begin(), known.end(), [&](const Known& k) { return k.name == name; });
}

std::vector<Measured> measured_of(const LoadPath& path, const std::vector<std::string>& offsets) {
    std::vector<Measured> all;
    for (const auto& k : known_columns(path.points.front().stress.has_value())) {
        const auto column = path.table.find(k.name);
        if (!column || k.given_by_path) continue;
        auto values = path.table.columns[*column];
        const bool free = std::find(offsets.begin(), offsets.end(), k.name) != offsets.end();
        const double middle = free ? mean_of(values) : 0;
        double largest = 0;
        for (const double v : values) largest = std::max(largest, std::abs(v - middle));
        if (largest > 0) all.push_back({k.name, std::move(values), k.of, free, largest, largest, {}});
    }
    if (all.empty())
        throw Diagnostic("the file has no measured column",
                         "add shear_stress, opening (for a path of normal_stress) or measured_normal_stress");
    for (const auto& name : offsets)
        if (name != "opening" &&
            std::none_of(all.begin(), all.end(), [&](const Measured& m) { return m.name == name; }))
            throw Diagnostic(fmt::format("the offset of '{}' cannot be found: no such column was measured", name),
                             "--offset takes names of measured columns: opening, shear_stress");
    return all;
}

int Residuals::freedom() const {
    const auto offsets =
        std::count_if(measured.begin(), measured.end(), [](const Measured& m) { return m.free_offset; });
    return values() - inputs() - static_cast<int>(offsets);
}

std::vector<double> Residuals::values_at(const Eigen::VectorXd& t) const {
    auto values = base;
    for (std::size_t k = 0; k < which.size(); ++k) values[which[k]] = free[k].value(t[static_cast<Eigen::Index>(k)]);
    return values;
}

Residuals::Left Residuals::left_of(const Measured& column, const JointCurve& curve) const {
    Left left{{}, 0};
    for (std::size_t i = 0; i < curve.at_path.size(); ++i)
        left.values.push_back(column.of(curve.points[curve.at_path[i]]) - column.values[i] +
                              (column.correction.empty() ? 0 : column.correction[i]));
    // An offset is linear: its optimum for each set of properties is the mean, so it need not be searched.
    if (column.free_offset) left.offset = mean_of(left.values);
    for (double& v : left.values) v -= left.offset;
    return left;
}

bool Residuals::evaluate(const Eigen::VectorXd& t, Eigen::VectorXd& residuals) const {
    const auto values_here = values_at(t);
    if (!model.check(values_here).empty()) return false;
    try {
        const JointCurve curve = follow_path(model, values_here, path, settings);
        Eigen::Index row = 0;
        for (const auto& m : measured)
            for (const double v : left_of(m, curve).values) residuals[row++] = v / m.scale;
    } catch (const Diagnostic&) { // with these values the model cannot carry the prescribed stress
        return false;
    }
    return residuals.allFinite();
}

int Residuals::df(const Eigen::VectorXd& t, Eigen::MatrixXd& jacobian) const {
    constexpr double part = 1e-4;
    Eigen::VectorXd up(values()), down(values()), here;
    int calls = 0;
    for (Eigen::Index k = 0; k < t.size(); ++k) {
        const double h = part * std::max(std::abs(t[k]), 0.1);
        Eigen::VectorXd there = t;
        double width = 2 * h;
        const auto try_at = [&](double at, Eigen::VectorXd& result) {
            there[k] = at;
            ++calls;
            if (evaluate(there, result)) return;
            width -= h; // refused on this side: use the other side
            if (here.size() == 0) here.resize(values()), (*this)(t, here), ++calls;
            result = here;
        };
        try_at(t[k] + h, up);
        try_at(t[k] - h, down);
        jacobian.col(k) = width > 0 ? ((up - down) / width).eval() : Eigen::VectorXd::Zero(values()).eval();
    }
    return calls;
}

double Residuals::sum_of_squares(const Eigen::VectorXd& t) const {
    Eigen::VectorXd r(values());
    (*this)(t, r);
    return r.squaredNorm();
}

double Residuals::correct_steps(const Eigen::VectorXd& t, const CurveSettings& many) {
    const JointCurve coarse = follow_path(model, values_at(t), path, settings),
                     fine = follow_path(model, values_at(t), path, many);
    double squares = 0;
    for (auto& m : measured) {
        m.correction.resize(m.values.size());
        // Without noise there is nothing to measure a change by but the column itself.
        const double unit = std::max(m.scale, 1e-4 * m.largest);
        for (std::size_t i = 0; i < m.values.size(); ++i) {
            const double now = m.of(fine.points[fine.at_path[i]]) - m.of(coarse.points[coarse.at_path[i]]);
            squares += std::pow((now - m.correction[i]) / unit, 2);
            m.correction[i] = now;
        }
    }
    return std::sqrt(squares);
}

} // namespace kaya
