#include "zonetest/zone_bench.hpp"

#include "base/diagnostic.hpp"
#include "laws/given_values.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

namespace {

/// Dependence of the result on the number of steps: the same path in half as many.
std::string step_text(const ZoneModel& model, const std::vector<double>& values, const ZonePath& path,
                      ZoneCurveSettings settings, const SingleZone& last) {
    if (settings.steps < 2) return "not tried: the path has one step";
    settings.steps /= 2;
    const ZoneCurve coarse = follow_zone_path(model, values, path, settings);
    double apart = 0, size = 1e-300;
    for (std::size_t k = 0; k < 6; ++k) {
        apart = std::max(apart, std::abs(last.stress[k] - coarse.points.back().stress[k]));
        size = std::max(size, std::abs(last.stress[k]));
    }
    return fmt::format("half as many change the stress at the end by {:.2g} of it", apart / size);
}

std::string report_of(const ZoneCurve& curve, const std::string& steps) {
    const auto greatest = std::ranges::max_element(curve.points, {}, &SingleZone::deviator);
    const auto& last = curve.points.back();
    std::string text;
    const auto line = [&](const char* what, const std::string& value) {
        text += fmt::format("  {:<18}{}\n", what, value);
    };
    line("deviator",
         fmt::format("greatest {:.6g} at time {:.6g}; {:.6g} at the end", greatest->deviator(),
                     curve.time[static_cast<std::size_t>(greatest - curve.points.begin())], last.deviator()));
    const auto six = [](const SixNumbers& v) {
        std::string out;
        for (std::size_t k = 0; k < 6; ++k)
            if (v[k] != 0) out += fmt::format("{}{} {:.6g}", out.empty() ? "" : ", ", component_names[k], v[k]);
        return out.empty() ? std::string("0") : out;
    };
    line("stress at the end", six(last.stress));
    line("strain at the end", six(last.strain));
    line("volume strain", fmt::format("{:.6g} at the end", last.volume_strain()));
    line("energy per volume", fmt::format("{:.6g} put in, {:.6g} taken up by flow", last.put_in, last.dissipated));
    line("steps", steps);
    for (const auto& f : curve.findings) line("found", fmt::format("step {}: {}", f.step, f.text));
    if (curve.findings.empty())
        line("found", "no work from flow, no stiffness above moduli(), rows are independent of each other");
    return text;
}

} // namespace

ZoneBenchReport run_zone_bench(ZoneModels& models, const ZoneBenchOrder& order) {
    const ZoneModel& model = models.get(order.model);
    const auto values = values_of(model, "zone model", order.values);
    const ZonePath path = read_zone_path(order.path);
    const ZoneCurve curve = follow_zone_path(model, values, path, order.settings);
    fs::path stem = order.output;
    if (stem.empty()) stem = fmt::format("{}-{}", order.path.stem().string(), model.name);
    const fs::path table = stem.string() + ".csv";
    std::error_code ignored;
    if (fs::equivalent(table, order.path, ignored))
        throw Diagnostic(fmt::format("{} is the path itself", table.string()), "give another name with --output");
    write_csv(zone_curve_table(curve), table);
    ZoneBenchReport report;
    report.figure = stem.string() + ".gp";
    write_whole_file(report.figure.string(),
                     zone_curve_figure(curve, fmt::format("{} along {}", model.name, order.path.stem().string())));
    report.odd = !curve.findings.empty();
    report.text = fmt::format("{} {} along {}: {} points\n", model.name, model.version, order.path.filename().string(),
                              path.points.size()) +
                  report_of(curve, step_text(model, values, path, order.settings, curve.points.back())) +
                  fmt::format("  wrote {}, {}", table.string(), report.figure.string());
    return report;
}

} // namespace kaya
