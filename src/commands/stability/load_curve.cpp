#include "commands/stability/load_curve.hpp"

#include "commands/conditions/tables.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

void LoadCurve::add(const CurveRow& row, bool at_rest) {
    rows_.push_back(row);
    const bool greater = row.load > rows_[peak_].load, first_at_rest = at_rest && !peak_at_rest_;
    if (first_at_rest || (greater && at_rest == peak_at_rest_)) peak_ = rows_.size() - 1;
    peak_at_rest_ = peak_at_rest_ || at_rest;
}

bool LoadCurve::stays_below(double load) const {
    constexpr std::size_t last = 3;
    return rows_.size() >= last && std::all_of(rows_.end() - last, rows_.end(), [&](const CurveRow& row) {
               return std::max(row.load, row.pushed) <= load;
           });
}

double LoadCurve::doubt_of_peak() const {
    constexpr double flat = 0.01; // of the peak, in the row behind it
    const double top = peak().load;
    if (!(top > 0) || peak_ + 1 == rows_.size() || top - rows_[peak_ + 1].load < flat * top) return 0;
    double step = 0;
    for (std::size_t row = peak_; row > 0 && row + 2 > peak_; --row)
        step = std::max(step, rows_[row].load - rows_[row - 1].load);
    return 1.5 * step / top; // a mean is half a step below its end, and the next one may have stopped at once
}

void LoadCurve::store(Session& session, const lang::SolveControl& command) const {
    if (command.table) {
        auto& table = session.engine.scripts->tables()[*command.table];
        table.points.clear();
        for (const CurveRow& row : rows_) table.points.push_back({row.displacement, row.load});
    }
    if (command.file.empty()) return;
    std::string text = "displacement,load,time,reaction_x,reaction_y,reaction_z,lost,damped,ratio,stored,zone_work\n";
    for (const CurveRow& row : rows_)
        text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n",
                            row.displacement, row.load, row.time, row.reaction.x(), row.reaction.y(), row.reaction.z(),
                            row.lost, row.damped, row.ratio, row.stored, row.zone_work);
    write_whole_file(session.program.output_file(command.file), text);
}

Chart LoadCurve::picture(const Session& session, const std::string& displacement, const std::string& load) const {
    const auto named = [&](const std::string& text) { return session.deck.units.in_brackets(text); };
    Chart chart;
    chart.title = session.deck.title.empty() ? "solve control" : session.deck.title;
    chart.x_label = named(displacement);
    chart.y_label = named(load);
    Curve curve{"load", {}, {}};
    for (const CurveRow& row : rows_) curve.x.push_back(row.displacement), curve.y.push_back(row.load);
    chart.curves.push_back(std::move(curve));
    chart.curves.push_back({fmt::format("peak {:.4g} at {:.4g}", peak().load, peak().displacement),
                            {peak().displacement},
                            {peak().load},
                            true});
    return chart;
}

} // namespace kaya
