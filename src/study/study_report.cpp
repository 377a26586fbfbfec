// report.html of a study: text and pictures in one file, with nothing from elsewhere.
#include "base/markup_text.hpp"
#include "scene/svg_chart.hpp"
#include "scene/ticks.hpp"
#include "study/study_answers.hpp"
#include "study/study_table.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

constexpr std::size_t most_rows = 500, most_lines = 2000, most_scatters = 24;

std::string rgb(const Colour& c) {
    return fmt::format("rgb({:.0f},{:.0f},{:.0f})", 255 * c[0], 255 * c[1], 255 * c[2]);
}

/// The columns of the table that are numbers and differ: parameters first, then results.
struct Axis {
    std::string name;
    std::vector<double> numbers; ///< by run; NaN where there is none
    double low = 0, high = 0;
    bool is_result = false;
    double part(std::size_t i) const { return (numbers[i] - low) / (high - low); }
};

std::vector<Axis> axes_of(const Study& study, const StudyAnswers& answers) {
    std::vector<Axis> axes;
    const auto take = [&](Axis axis) {
        axis.low = std::numeric_limits<double>::infinity(), axis.high = -axis.low;
        for (const double number : axis.numbers)
            if (std::isfinite(number)) axis.low = std::min(axis.low, number), axis.high = std::max(axis.high, number);
        if (axis.low < axis.high) axes.push_back(std::move(axis));
    };
    if (answers.cases.empty()) return axes;
    for (std::size_t j = 0; j < answers.cases[0].values.size(); ++j) {
        Axis axis{answers.cases[0].values[j].first, {}, 0, 0, false};
        for (const auto& one : answers.cases) axis.numbers.push_back(number_of(one.values[j].second));
        take(std::move(axis));
    }
    for (const auto& asked : study.asked) {
        Axis axis{asked.name, {}, 0, 0, true};
        for (const auto& outcome : answers.outcomes) axis.numbers.push_back(number_of(result_of(outcome, asked.name)));
        take(std::move(axis));
    }
    return axes;
}

std::string svg_begin(int width, int height) {
    return fmt::format(
        "<svg viewBox=\"0 0 {} {}\" width=\"{}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\">\n", width,
        height, width);
}

/// One line for each run through all axes, coloured by the last axis.
std::string parallel_lines(const std::vector<Axis>& axes) {
    if (axes.size() < 2) return {};
    const int width = 160 * static_cast<int>(axes.size()) + 40, height = 380;
    const auto across = [&](std::size_t k) { return 100.0 + 160.0 * static_cast<double>(k); };
    const auto up = [&](double part) { return 340 - 290 * part; };
    std::string svg = svg_begin(width, height);
    const std::size_t runs = axes[0].numbers.size(), every = runs / most_lines + 1;
    for (std::size_t i = 0; i < runs; i += every) {
        if (std::ranges::any_of(axes, [&](const Axis& axis) { return !std::isfinite(axis.numbers[i]); })) continue;
        std::string path;
        for (std::size_t k = 0; k < axes.size(); ++k)
            path += fmt::format("{}{:.0f} {:.1f}", k == 0 ? 'M' : 'L', across(k), up(axes[k].part(i)));
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-opacity=\"0.5\"/>\n", path,
                           rgb(sequential_colour(axes.back().part(i))));
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
        svg += fmt::format(
            "<path d=\"M{0:.0f} 50V340\" stroke=\"#333\"/><text x=\"{0:.0f}\" y=\"20\" text-anchor=\"middle\" font-weight=\"bold\">{1}</text>\n",
            across(k), markup_text(axes[k].name));
        svg += fmt::format(
            "<text x=\"{0:.0f}\" y=\"40\" text-anchor=\"middle\">{1:.4g}</text><text x=\"{0:.0f}\" y=\"362\" text-anchor=\"middle\">{2:.4g}</text>\n",
            across(k), axes[k].high, axes[k].low);
    }
    return svg + "</svg>\n";
}

std::string scatter(const Axis& x, const Axis& y) {
    constexpr int width = 340, height = 260;
    const Ticks tx = round_ticks(x.low, x.high, 4), ty = round_ticks(y.low, y.high, 4);
    const auto across = [&](double v) { return 60 + 265 * (v - tx.low) / (tx.high - tx.low); };
    const auto up = [&](double v) { return 210 - 190 * (v - ty.low) / (ty.high - ty.low); };
    std::string svg = svg_begin(width, height);
    for (const double v : tx.values())
        svg += fmt::format(
            "<path d=\"M{0:.1f} 20V210\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"226\" text-anchor=\"middle\" font-size=\"11\">{1}</text>\n",
            across(v), tx.label(v));
    for (const double v : ty.values())
        svg += fmt::format(
            "<path d=\"M60 {0:.1f}H325\" stroke=\"#ddd\"/><text x=\"55\" y=\"{1:.1f}\" text-anchor=\"end\" font-size=\"11\">{2}</text>\n",
            up(v), up(v) + 4, ty.label(v));
    for (std::size_t i = 0; i < x.numbers.size(); i += x.numbers.size() / most_lines + 1)
        if (std::isfinite(x.numbers[i]) && std::isfinite(y.numbers[i]))
            svg +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"#0072b2\" fill-opacity=\"0.6\"/>\n",
                            across(x.numbers[i]), up(y.numbers[i]));
    svg += fmt::format("<text x=\"192\" y=\"250\" text-anchor=\"middle\">{}</text><text x=\"60\" y=\"13\">{}</text>\n",
                       markup_text(x.name), markup_text(y.name));
    return svg + "</svg>\n";
}

/// The part of all runs at or below each value, where each run counts with its weight.
std::string distribution_curve(const Axis& axis, const std::vector<Case>& cases) {
    std::vector<std::pair<double, double>> sorted; // number and weight
    double all = 0;
    for (std::size_t i = 0; i < axis.numbers.size(); ++i)
        if (std::isfinite(axis.numbers[i]))
            sorted.emplace_back(axis.numbers[i], cases[i].weight), all += cases[i].weight;
    std::ranges::sort(sorted);
    Chart chart;
    chart.width = 560, chart.height = 360;
    chart.x_label = axis.name, chart.y_label = "part of the runs at or below";
    Curve curve{"", {}, {}};
    double below = 0;
    for (const auto& [number, weight] : sorted) {
        curve.x.push_back(number), curve.y.push_back(below / all);
        below += weight;
        curve.x.push_back(number), curve.y.push_back(below / all);
    }
    chart.curves.push_back(std::move(curve));
    return svg_of(chart);
}

std::string tornado(std::vector<Bar> bars) {
    std::erase_if(bars, [](const Bar& bar) { return !bar.is_known(); });
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& bar : bars) low = std::min({low, bar.low, bar.high}), high = std::max({high, bar.low, bar.high});
    if (!(low < high)) return {};
    const int height = 40 + 34 * static_cast<int>(bars.size());
    const auto across = [&](double v) { return 200 + 420 * (v - low) / (high - low); };
    std::string svg = svg_begin(720, height);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const auto& bar = bars[i];
        const int y = 10 + 34 * static_cast<int>(i);
        const double left = across(std::min(bar.low, bar.high)), right = across(std::max(bar.low, bar.high));
        svg += fmt::format(
            "<text x=\"190\" y=\"{}\" text-anchor=\"end\">{}</text><rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"22\" fill=\"{}\"/>\n",
            y + 16, markup_text(bar.parameter), left, y, std::max(1.0, right - left),
            bar.high >= bar.low ? "#0072b2" : "#d55e00");
        const std::string text = bar.low_text.empty() ? fmt::format("{:.3f}", bar.high)
                                                      : fmt::format("{} to {}", bar.low_text, bar.high_text);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\">{}</text>\n", right + 6, y + 16, markup_text(text));
    }
    svg += fmt::format(
        "<text x=\"200\" y=\"{0}\" text-anchor=\"middle\">{1:.4g}</text><text x=\"620\" y=\"{0}\" text-anchor=\"middle\">{2:.4g}</text>\n",
        height - 6, low, high);
    return svg + "</svg>\n";
}

/// The table as rows of HTML, from the same text as results.csv.
std::string table(const StudyAnswers& answers, const std::vector<Asked>& asked) {
    const std::size_t rows = std::min(most_rows, answers.cases.size());
    const std::vector<Case> cases(answers.cases.begin(), answers.cases.begin() + static_cast<std::ptrdiff_t>(rows));
    const std::vector<Outcome> outcomes(answers.outcomes.begin(),
                                        answers.outcomes.begin() + static_cast<std::ptrdiff_t>(rows));
    std::string page = "<table><tr><th>run</th>";
    if (!cases.empty())
        for (const auto& [name, value] : cases[0].values) page += "<th>" + markup_text(name) + "</th>";
    for (const auto& one : asked) page += "<th>" + markup_text(one.name) + "</th>";
    page += "<th>end</th><th>cycles</th><th>message</th></tr>\n";
    for (std::size_t i = 0; i < rows; ++i) {
        page += fmt::format("<tr><td>{}</td>", cases[i].number);
        for (const auto& [name, value] : cases[i].values) page += "<td>" + markup_text(text_of(value)) + "</td>";
        for (const auto& one : asked) page += "<td>" + markup_text(text_of(result_of(outcomes[i], one.name))) + "</td>";
        page += fmt::format("<td>{}</td><td>{}</td><td class=\"text\">{}</td></tr>\n", name_of(outcomes[i].end),
                            outcomes[i].cycles, markup_text(outcomes[i].message));
    }
    page += "</table>\n";
    if (rows < answers.cases.size())
        page += fmt::format("<p>{} more runs stand in results.csv.</p>\n", answers.cases.size() - rows);
    return page;
}

constexpr const char* style =
    "body{font:16px/1.5 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;color:#222}"
    "pre{background:#f5f5f5;padding:1em;overflow:auto}table{border-collapse:collapse;font-size:13px}"
    "th,td{border-bottom:1px solid #ddd;padding:2px 8px;text-align:right}td.text{text-align:left}"
    "div.wide{overflow:auto}svg{max-width:100%;height:auto}";

} // namespace

std::string report_page(const Study& study, const StudyAnswers& answers, const std::string& version) {
    const std::string title = markup_text(study.title.empty() ? study.file : study.title);
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>{}</style></head><body>\n<h1>{}</h1>\n",
        title, style, title);
    page += fmt::format("<p>Study {} of the deck {}, run by kaya {}.</p>\n", markup_text(study.file),
                        markup_text(study.deck), markup_text(version));
    page += "<h2>Results</h2>\n<pre>" + markup_text(summary_text(study, answers)) + "</pre>\n";
    if (!answers.tornado.empty())
        page += fmt::format("<h2>Sensitivity of {}</h2>\n{}", markup_text(study.tornado_of), tornado(answers.tornado));
    const auto axes = axes_of(study, answers);
    if (axes.size() >= 2) page += "<h2>All runs</h2>\n<div class=\"wide\">" + parallel_lines(axes) + "</div>\n";
    std::string scatters;
    std::size_t count = 0;
    for (const auto& y : axes)
        for (const auto& x : axes)
            if (y.is_result && !x.is_result && count++ < most_scatters) scatters += scatter(x, y);
    if (!scatters.empty()) page += "<h2>Results over parameters</h2>\n" + scatters;
    std::string curves;
    for (const auto& axis : axes)
        if (axis.is_result) curves += distribution_curve(axis, answers.cases);
    if (!curves.empty()) page += "<h2>Distributions</h2>\n" + curves;
    page += "<h2>Runs</h2>\n<div class=\"wide\">" + table(answers, study.asked) + "</div>\n<h2>The study</h2>\n<pre>" +
            markup_text(study.text) + "</pre>\n</body></html>\n";
    return page;
}

} // namespace kaya
