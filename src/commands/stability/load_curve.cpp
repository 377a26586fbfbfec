#include "commands/stability/load_curve.hpp"

#include "commands/conditions/tables.hpp"
#include "commands/plot/pictures.hpp"
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

void LoadCurve::draw(Session& session, const lang::SolveControl& command, const std::string& displacement,
                     const std::string& load) const {
    if (rows_.empty()) return;
    const auto chart = [&](const std::string& label) {
        Chart chart;
        chart.title = session.deck.title.empty() ? "solve control" : session.deck.title;
        chart.x_label = session.deck.units.in_brackets(displacement);
        chart.y_label = session.deck.units.in_brackets(label);
        return chart;
    };
    const auto curve = [&](const std::string& name, const auto& value) {
        Curve curve{name, {}, {}};
        for (const CurveRow& row : rows_) curve.x.push_back(row.displacement), curve.y.push_back(value(row));
        return curve;
    };
    if (!command.picture.empty()) {
        Chart of_load = chart(load);
        of_load.curves = {curve("load", [](const CurveRow& row) { return row.load; }),
                          {fmt::format("peak {:.4g} at {:.4g}", peak().load, peak().displacement),
                           {peak().displacement},
                           {peak().load},
                           true}};
        write_chart(session, of_load, command.picture);
    }
    if (!command.reactions.empty()) {
        Chart of_reactions = chart("sum of reactions [force]");
        for (const int k : {0, 1, 2})
            of_reactions.curves.push_back(
                curve(std::string{"xyz"[k]}, [k](const CurveRow& row) { return row.reaction[k]; }));
        write_chart(session, of_reactions, command.reactions);
    }
    if (!command.energies.empty()) {
        Chart of_energies = chart("energy [energy]");
        of_energies.curves = {curve("stored in joints", [](const CurveRow& row) { return row.stored; }),
                              curve("lost in slip and failure", [](const CurveRow& row) { return row.lost; }),
                              curve("damped", [](const CurveRow& row) { return row.damped; })};
        if (session.engine.model.zones.size() > 0)
            of_energies.curves.push_back(curve("work on zones", [](const CurveRow& row) { return row.zone_work; }));
        write_chart(session, of_energies, command.energies);
    }
}

} // namespace kaya
