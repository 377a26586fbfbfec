#include "commands/stability/load_curve.hpp"

#include "commands/conditions/tables.hpp"
#include "commands/plot/pictures.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

constexpr std::size_t last_rows = 4; // the one before the peak, the peak, and two behind it

} // namespace

void LoadCurve::add(const CurveRow& row, std::vector<CurveRow> parts) {
    rows_.push_back(row);
    if (is_peak(row)) peak_ = rows_.size() - 1;
    if (last_.size() == last_rows) last_.erase(last_.begin());
    last_.push_back({row, std::move(parts), rows_.size() - 1});
    // How the load rose to the first row is unknown.
    const bool is_doubtful = peak_ == 0 || doubt_of_peak() > much_doubt;
    if (peak_ >= last_.front().first && drops_after_peak() && is_doubtful) divide_last();
}

bool LoadCurve::drops_after_peak() const {
    constexpr double flat = 0.01; // of the peak
    const double top = peak().load;
    const auto falls = [&](std::size_t row) { return row < rows_.size() && top - rows_[row].load >= flat * top; };
    // A row that holds the true peak and what follows it may move, and have the greater load.
    return top > 0 && (falls(peak_ + 1) || (falls(peak_ + 2) && peak().at_rest && !rows_[peak_ + 1].at_rest));
}

/// Puts parts in the place of the last rows, unless none of them is as high a peak as the row that is it now.
void LoadCurve::divide_last() {
    const CurveRow whole = peak();
    LoadCurve divided;
    divided.rows_.assign(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(last_.front().first));
    for (Added added : last_) {
        added.first = divided.rows_.size();
        const auto& rows = added.parts.empty() ? std::vector{added.row} : added.parts;
        divided.rows_.insert(divided.rows_.end(), rows.begin(), rows.end());
        divided.last_.push_back(std::move(added));
    }
    for (std::size_t row = 0; row < divided.rows_.size(); ++row)
        if (divided.is_peak(divided.rows_[row])) divided.peak_ = row;
    if (divided.peak().at_rest == whole.at_rest && divided.peak().load >= whole.load) *this = std::move(divided);
}

bool LoadCurve::stays_below(double load) const {
    constexpr std::size_t wanted = 3;
    return last_.size() >= wanted && std::all_of(last_.end() - wanted, last_.end(), [&](const Added& added) {
               return std::max(added.row.load, added.row.pushed) <= load;
           });
}

double LoadCurve::doubt_of_peak() const {
    if (!drops_after_peak()) return 0;
    double step = 0;
    for (std::size_t row = peak_; row > 0 && row + 2 > peak_; --row)
        step = std::max(step, rows_[row].load - rows_[row - 1].load);
    return 1.5 * step / peak().load; // a mean is half a step below its end, and the next one may have stopped at once
}

int LoadCurve::swings_at_peak(double part) const {
    constexpr std::size_t near = 50; // rows before it, and behind it
    const double least = part * (rows_.empty() ? 0 : peak().load);
    if (!(least > 0)) return 0;
    int swings = 0;
    bool falls = false;
    double turn = 0; // the highest load, or the lowest while it falls
    for (std::size_t row = peak_ - std::min(peak_, near); row < std::min(peak_ + near + 1, rows_.size()); ++row) {
        if (peak().at_rest && !rows_[row].at_rest) continue; // a row in motion cannot be the peak
        const double load = rows_[row].load;
        turn = falls ? std::min(turn, load) : std::max(turn, load);
        if (std::abs(load - turn) < least) continue;
        if (falls) ++swings;
        falls = !falls;
        turn = load;
    }
    return swings;
}

void LoadCurve::store(Session& session, const lang::SolveControl& command) const {
    if (command.table) {
        std::vector<script::TablePoint> points;
        for (const CurveRow& row : rows_) points.push_back({row.displacement, row.load});
        session.engine.scripts->tables()[*command.table].replace(std::move(points));
    }
    if (command.file.empty()) return;
    std::string text =
        "displacement,load,time,reaction_x,reaction_y,reaction_z,lost,damped,ratio,stored,zone_work,at_rest\n";
    for (const CurveRow& row : rows_)
        text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:d}\n",
                            row.displacement, row.load, row.time, row.reaction.x(), row.reaction.y(), row.reaction.z(),
                            row.lost, row.damped, row.ratio, row.stored, row.zone_work, row.at_rest);
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
