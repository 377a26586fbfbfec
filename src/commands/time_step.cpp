#include "commands/time_step.hpp"

#include "base/diagnostic.hpp"
#include "mechanics/step_bounds.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

/// Whether something moves at a velocity that the deck prescribes.
bool has_velocity_history(const Model& model) {
    const auto& blocks = model.blocks;
    const auto& points = model.gridpoints;
    const auto moves = [&](unsigned fixed, std::int32_t roller, const Vec3& velocity) {
        for (int k = 0; k < 3; ++k)
            if ((fixed & (1u << k)) && velocity[k] != 0) return true;
        return !model.rollers[static_cast<std::size_t>(roller)].speed.isZero(0);
    };
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks.deformable[b] &&
            moves(blocks.fixed[b], points.roller[blocks.gridpoints[b].first], blocks.velocity[b]))
            return true;
    for (std::size_t g = 0; g < points.size(); ++g)
        if (blocks.deformable[points.block[g]] && moves(points.fixed[g], points.roller[g], points.velocity[g]))
            return true;
    return false;
}

} // namespace

void warn_of_long_step(Session& session) {
    const Model& model = session.model;
    const double given = model.settings.given_time_step;
    if (given == 0 || session.said_once.contains("long step")) return;
    const Adjacency adjacency = make_adjacency(model);
    StepBounds bounds;
    bounds.update(model, adjacency);
    const double stable = bounds.limit(model, adjacency).stable;
    if (given <= stable) return;
    session.said_once.insert("long step");
    Diagnostic d(
        fmt::format("the time step {:.6g} is longer than {:.6g}, up to which it is surely stable", given, stable),
        "it is taken, since the highest frequency is estimated to be low enough; the run stops when the account of energy "
        "shows that it is not");
    d.add(session.cycle->time_step_report());
    session.warn(d);
}

void note_counted_cycles(Session& session) {
    if (session.model.settings.given_time_step > 0 || !has_velocity_history(session.model)) return;
    session.note_once(
        "cycles are counted while a boundary moves at a given velocity: how far it comes depends on the time step",
        "that of 3DEC for this model is not known, and may be another; `cycle time T` does not depend on it");
}

} // namespace kaya
