#include "jointtest/curve_fit.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

std::string line(std::string_view what, const std::string& value) { return fmt::format("  {:<18}{}\n", what, value); }

std::string value_text(const FittedProperty& p) {
    const std::string limit = p.at_limit ? ", at a limit of the model's table" : "";
    if (std::isnan(p.deviation)) return fmt::format("{:.6g}, which the curve does not determine{}", p.value, limit);
    return fmt::format("{:.6g} ± {:.2g} (95 %: {:.4g} to {:.4g}){}", p.value, p.deviation, p.value - p.margin,
                       p.value + p.margin, limit);
}

/// Below the diagonal; correlations near 1 are pointed out in words.
std::string correlation_text(const CurveFit& fit) {
    std::string text;
    for (std::size_t a = 1; a < fit.properties.size(); ++a) {
        std::string row;
        for (std::size_t b = 0; b < a; ++b) {
            const double value = fit.correlation[a][b];
            if (!std::isnan(value))
                row += fmt::format("{}{:+.3f} with {}", row.empty() ? "" : ", ", value, fit.properties[b].name);
        }
        if (!row.empty()) text += line("correlation", fmt::format("{} {}", fit.properties[a].name, row));
        for (std::size_t b = 0; b < a; ++b)
            if (std::abs(fit.correlation[a][b]) > 0.95)
                text += line("", fmt::format("{} and {} can hardly be distinguished: fix one of them, or "
                                             "measure at another normal stress",
                                             fit.properties[a].name, fit.properties[b].name));
    }
    return text;
}

std::string column_text(const FittedColumn& c) {
    std::string text = fmt::format("noise {:.3g}, {:.2g} % of the largest", c.noise, 100 * c.noise / c.largest);
    if (c.offset) text += fmt::format("; zero at {:.4g}", *c.offset);
    if (c.waves)
        text += "; what is left comes in waves: the model does not follow the curve, and the intervals are "
                "too narrow";
    return text;
}

std::string search_text(const FitSearch& s) {
    std::string text = fmt::format("{} of {} starts lead here", s.agreed, s.starts);
    if (s.next_misfit > 0) text += fmt::format("; the next minimum has a misfit of {:.3g}", s.next_misfit);
    text = line("search", text);
    if (s.first_was_false) text += line("", "the values given lead to a worse minimum");
    if (!s.doubt.empty()) text += line("doubtful", s.doubt);
    return text;
}

} // namespace

std::string fit_text(const CurveFit& fit) {
    std::string text =
        line("misfit", fmt::format("{:.3g} before, {:.3g} after (root of the mean square, part of the largest value)",
                                   fit.misfit_before, fit.misfit));
    for (const auto& p : fit.properties) text += line(p.name, value_text(p));
    text += correlation_text(fit);
    for (const auto& c : fit.columns) text += line(c.name, column_text(c));
    return text + search_text(fit.search);
}

} // namespace kaya
