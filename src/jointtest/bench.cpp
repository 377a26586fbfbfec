#include "jointtest/bench.hpp"

#include "base/diagnostic.hpp"
#include "laws/arithmetic.hpp"
#include "laws/given_values.hpp"
#include "jointtest/fit_residuals.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Least and largest of a quantity over a curve.
struct Span {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    void add(double value) { least = std::min(least, value), largest = std::max(largest, value); }
    std::string text() const { return fmt::format("{:.6g} to {:.6g}", least, largest); }
};

/// Columns that neither a path nor a measured curve has.
std::vector<std::string> unread_columns(const LoadPath& path) {
    std::vector<std::string> names;
    for (const auto& name : path.table.names)
        if (!is_path_column(name) && !is_measured_column(name)) names.push_back(name);
    return names;
}

/// Columns that the bench does not use, and inputs that it lacks.
std::string remarks(const BenchOrder& order, const LoadPath& path) {
    std::string text;
    if (const auto names = unread_columns(path); !names.empty())
        text += fmt::format("  {:<18}{}; columns of a path are {}\n", "not read", fmt::join(names, ", "),
                            fmt::join(path_columns, ", "));
    if (!order.missed_tables->empty())
        text += fmt::format(
            "  {:<18}the model asks for table {}, and the bench has none; 'jmodel test' in a deck has those of the deck\n",
            "no tables", fmt::join(*order.missed_tables, ", "));
    return text;
}

/// The largest difference of two answers, as a part of the largest answer.
struct Difference {
    double apart = 0, largest = 0;
    void add(double fine, double coarse) {
        apart = std::max(apart, std::abs(fine - coarse)), largest = std::max(largest, std::abs(fine));
    }
    std::string text() const {
        constexpr double rounding = 1e-6;
        return apart <= rounding * largest ? std::string("less than 1e-6") : fmt::format("{:.2g}", apart / largest);
    }
};

/// Dependence of the answer on the number of steps: the same path in half as many, at the points of the path.
std::string step_text(const JointModel& model, const std::vector<double>& values, const LoadPath& path,
                      CurveSettings settings, const JointCurve& curve) {
    if (settings.steps < 2) return "not compared with fewer: the pieces of the path have one step";
    settings.steps /= 2;
    settings.tangents = false;
    JointCurve coarse;
    try {
        coarse = follow_path(model, values, path, settings);
    } catch (const Diagnostic& error) { return fmt::format("half as many fail: {}", error.message); }
    Difference stress, opening, work;
    for (std::size_t k = 0; k < curve.at_path.size(); ++k) {
        const CurvePoint &fine = curve.points[curve.at_path[k]], &other = coarse.points[coarse.at_path[k]];
        stress.add(fine.normal_stress, other.normal_stress);
        for (std::size_t i = 0; i < 2; ++i) stress.add(fine.resistance[i], other.resistance[i]);
        opening.add(fine.opening, other.opening);
        work.add(fine.put_in, other.put_in);
    }
    return fmt::format("half as many change the stress by {}, the opening by {} and the work by {} of the largest",
                       stress.text(), opening.text(), work.text());
}

std::string report_of(const JointCurve& curve, const std::string& steps) {
    Span shear, normal, opening, normal_ratio, shear_ratio;
    double peak_at = 0;
    for (const auto& p : curve.points) {
        if (p.resistance[0] > shear.largest) peak_at = p.shear[0];
        shear.add(p.resistance[0]);
        normal.add(p.normal_stress);
        opening.add(p.opening);
        if (p.normal_tangent != 0) normal_ratio.add(p.normal_tangent / p.normal_stiffness);
        if (p.shear_tangent != 0 && p.shear_stiffness > 0) shear_ratio.add(p.shear_tangent / p.shear_stiffness);
    }
    const auto& last = curve.points.back();
    std::string text;
    const auto line = [&](const char* what, const std::string& value) {
        text += fmt::format("  {:<18}{}\n", what, value);
    };
    line("shear stress",
         fmt::format("{}, largest at {:.6g}; {:.6g} at the end", shear.text(), peak_at, last.resistance[0]));
    line("normal stress", normal.text());
    line("opening", opening.text());
    line("energy per area", fmt::format("work done {:.6g}, dissipated {:.6g}", last.put_in, last.taken_up));
    if (std::isfinite(normal_ratio.least))
        line("normal tangent", fmt::format("{} of the stiffness reported", normal_ratio.text()));
    if (std::isfinite(shear_ratio.least))
        line("shear tangent", fmt::format("{} of the stiffness reported", shear_ratio.text()));
    if (!steps.empty()) line("steps", steps);
    for (const auto& f : curve.findings) line("found", fmt::format("step {}: {}", f.step, f.text));
    if (curve.findings.empty()) line("found", "no jump, no energy from nothing, no stiffness above the one reported");
    return text;
}

} // namespace

BenchReport run_bench(JointRegistry& registry, const BenchOrder& order) {
    const JointModel& model = registry.get(order.model);
    const auto values = values_of(model, "joint model", order.values);
    const LoadPath path = read_load_path(order.path);
    BenchReport report;
    JointCurve curve;
    std::string steps;
    std::string heading = fmt::format("{} {} along {}: {} points\n", model.name, model.version,
                                      order.path.filename().string(), path.points.size());
    if (order.fitted.empty()) {
        curve = follow_path(model, values, path, order.settings);
        steps = step_text(model, values, path, order.settings, curve);
    } else {
        CurveFit fit = fit_curve(model, values, order.fitted, path, {order.settings, order.offsets});
        heading += fit_text(fit);
        report.doubtful = !fit.search.doubt.empty();
        curve = std::move(fit.curve);
    }
    fs::path stem = order.output;
    if (stem.empty()) stem = fmt::format("{}-{}", order.path.stem().string(), model.name);
    report.curve = fs::path(stem.string() + ".csv");
    report.figure = fs::path(stem.string() + ".gp");
    std::error_code ignored;
    if (fs::equivalent(report.curve, order.path, ignored))
        throw Diagnostic(fmt::format("{} is the path itself", report.curve.string()),
                         "give another name with --output");
    if (order.before_writing)
        for (const auto& file : {report.curve, report.figure}) order.before_writing(file);
    write_csv(curve_table(curve, model), report.curve);
    write_whole_file(report.figure.string(),
                     curve_figure(curve, fmt::format("{} along {}", model.name, order.path.stem().string())));
    if (model.arithmetic() != 0)
        curve.findings.push_back(
            {0, fmt::format("it changes {}; that was put back after each call", text_of_changes(model.arithmetic()))});
    if (const auto fault = fault_without_area(model, values); !fault.empty()) curve.findings.push_back({0, fault});
    report.odd = !curve.findings.empty();
    report.text = heading + report_of(curve, steps) + remarks(order, path) +
                  fmt::format("  wrote {}, {}", report.curve.string(), report.figure.string());
    return report;
}

} // namespace kaya
