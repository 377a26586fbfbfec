#include "commands/stability/other_motion.hpp"

#include "base/diagnostic.hpp"
#include "commands/stability/scaled_histories.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>

namespace kaya {

namespace {

/// Whether a function gives another number later. A variable of scripts may hold a load constant.
bool changes_with_time(const Session& session, const TimeFunction& function) {
    if (function.kind == TimeFunction::Kind::script) return false;
    const double now = session.engine.model.clock.time;
    if (function.kind != TimeFunction::Kind::table) return function.duration == 0 || now <= function.duration;
    const auto& tables = session.engine.scripts->tables();
    const auto found = tables.find(function.table);
    return found != tables.end() && !found->second.points().empty() && now < found->second.points().back().x;
}

/// Of a script: whether its value is another one than 0.
bool is_moving(Session& session, const TimeFunction& function, const Place& place) {
    return function.kind != TimeFunction::Kind::script || session.engine.scripts->number(function.script, place) != 0;
}

void refuse_time(Session& session, const lang::SolveControl& command) {
    const Model& model = session.engine.model;
    const auto& histories = model.boundary_histories;
    for (std::size_t i = 0; i < histories.size(); ++i) {
        const Row b = model.blocks.ids.row(histories.block[i]);
        if (b == no_row) continue;
        const TimeFunction& function = model.time_functions[static_cast<std::size_t>(histories.function[i])];
        if (is_variable(function, command.variable)) continue;
        const bool velocity = histories.what[i] == BoundaryHistories::What::velocity;
        if (velocity ? is_moving(session, function, command.place) : changes_with_time(session, function))
            throw Diagnostic(fmt::format("{} block {} changes with time, and this run goes as slowly as it needs to",
                                         velocity ? "the velocity of" : "a load on", model.blocks.number[b]),
                             velocity ? "hold it, e.g. with `fix`, or drive it with `scale @name`"
                                      : "replace it by a load that does not change")
                .at(command.place);
    }
}

/// Components whose velocity is prescribed as another one than 0, without a history.
class MovingSupports {
public:
    explicit MovingSupports(const Model& model) : model_(model) {
        const auto& histories = model.boundary_histories;
        for (std::size_t i = 0; i < histories.size(); ++i)
            if (histories.what[i] == BoundaryHistories::What::velocity)
                with_history_.insert(
                    {model.blocks.ids.row(histories.block[i]), histories.gridpoint[i], histories.component[i]});
    }

    /// A block that has one; no_row if there is none.
    Row first() const {
        for (Row b = 0; b < static_cast<Row>(model_.blocks.size()); ++b)
            if (moves(b)) return b;
        return no_row;
    }

private:
    bool moves(Row b) const {
        const auto& blocks = model_.blocks;
        const auto& points = model_.gridpoints;
        const Span span = blocks.gridpoints[b];
        for (Row g = span.first; g < span.end(); ++g) {
            if (!model_.rollers[static_cast<std::size_t>(points.roller[g])].speed.isZero(0)) return true;
            for (int k = 0; blocks.deformable[b] && k < 3; ++k)
                if ((points.fixed[g] & (1 << k)) && points.velocity[g][k] != 0 && !has_history(b, g - span.first, k))
                    return true;
        }
        for (int k = 0; !blocks.deformable[b] && k < BoundaryHistories::motions; ++k)
            if ((blocks.fixed[b] & (1 << k)) && !has_history(b, no_row, k) &&
                (k < 3 ? blocks.velocity[b][k] : blocks.rotational_velocity[b][k - 3]) != 0)
                return true;
        return false;
    }
    bool has_history(Row b, Row vertex, int component) const {
        return with_history_.contains({b, vertex, component}) || with_history_.contains({b, no_row, component});
    }

    const Model& model_;
    std::set<std::array<std::int32_t, 3>> with_history_;
};

} // namespace

void refuse_other_motion(Session& session, const lang::SolveControl& command) {
    const Model& model = session.engine.model;
    if (model.settings.damping == Damping::none && model.settings.contact_damping == 0)
        throw Diagnostic("solve control needs damping: without it the model keeps each vibration", "write `damp local`")
            .at(command.place);
    refuse_time(session, command);
    if (const Row b = MovingSupports(model).first(); b != no_row)
        throw Diagnostic(fmt::format("block {} is moved by a prescribed velocity, which this run does not control",
                                     model.blocks.number[b]),
                         "hold it, or drive it: `apply xvel 1 hist @name`, and `scale @name`")
            .at(command.place);
    if (std::ranges::any_of(model.triangles.quiet, [](std::uint8_t bits) { return bits != 0; }))
        throw Diagnostic(
            "a quiet boundary resists by its speed, and bears no load at rest",
            "hold it instead: remove it with `bound xfree yfree zfree` on its faces, and `fix` or `bound xvel 0`")
            .at(command.place);
}

} // namespace kaya
