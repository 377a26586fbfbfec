#include "commands/run/time_step.hpp"

#include "base/diagnostic.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/program/text_table.hpp"
#include "mechanics/step/step_bounds.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <array>
#include <fmt/format.h>
#include <vector>

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

/// Cost of a longer step: bodies with a shorter stable step get more mass.
struct AddedMass {
    double step = 0;
    double part = 0; ///< of the mass that moves
    std::size_t bodies = 0;
};

/// For the step of the true masses and multiples of it, until more than the whole mass is added.
std::vector<AddedMass> added_masses(const Model& model) {
    constexpr std::array multiples{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000};
    const Adjacency adjacency = make_adjacency(model);
    StepBounds bounds;
    bounds.update(model, adjacency);
    const StepLimit limit = bounds.limit(model, adjacency, Masses::real);
    if (!limit.exists()) return {};
    const BodyStiffness& stiffness = bounds.stiffness(model, adjacency);
    std::vector<AddedMass> rows;
    for (const int multiple : multiples) {
        AddedMass row{multiple * limit.stable * time_step_fraction(model.settings), 0, 0};
        double whole = 0, added = 0;
        const auto add = [&](const Resistance& body, double mass) {
            if (!body.acts()) return;
            whole += mass;
            const double more = body.needed_for(multiple * limit.stable) - mass;
            if (!(more > 1e-6 * mass)) return;
            added += more;
            ++row.bodies;
        };
        for (std::size_t b = 0; b < model.blocks.size(); ++b) add(stiffness.of_block[b], model.blocks.mass[b]);
        for (std::size_t g = 0; g < model.gridpoints.size(); ++g)
            add(stiffness.of_gridpoint[g], model.gridpoints.mass[g]);
        row.part = whole > 0 ? added / whole : 0;
        rows.push_back(row);
        if (row.part > 1) break;
    }
    return rows;
}

} // namespace

std::string added_mass_table(const Model& model) {
    TextTable table({"mscale part", "added mass, %", "bodies"});
    for (const AddedMass& row : added_masses(model))
        table.add({number_text(row.step), fmt::format("{:.3g}", 100 * row.part), std::to_string(row.bodies)});
    return table.size() > 0 ? table.text() : "";
}

void note_added_mass(Session& session) {
    const Settings& settings = session.engine.model.settings;
    const bool to_rest =
        settings.mass_scaling == MassScaling::none && !settings.dynamic && settings.given_time_step == 0;
    const std::string key = "added mass"; // the message has numbers, which would make it another one each time
    if (!to_rest || session.program.said_once.contains(key) || has_velocity_history(session.engine.model)) return;
    constexpr double little = 0.01; // of the mass
    constexpr double much = 10;     // times the step
    const std::vector<AddedMass> rows = added_masses(session.engine.model);
    const AddedMass* best = nullptr;
    for (const AddedMass& row : rows)
        if (row.part <= little) best = &row;
    if (!best || best->step < much * rows.front().step) return;
    session.program.said_once.insert(key);
    session.note_once(
        fmt::format(
            "a few small or stiff bodies set the time step: with {:.2g} % more mass it would be {:.0f} times as long",
            100 * best->part, best->step / rows.front().step),
        fmt::format("`mscale part {}`, or `mscale on` where only rest counts; `list timestep` shows more",
                    number_text(best->step)));
}

void warn_of_long_step(Session& session) {
    const Model& model = session.engine.model;
    const double given = model.settings.given_time_step;
    if (given == 0 || session.program.said_once.contains("long step")) return;
    const Adjacency adjacency = make_adjacency(model);
    StepBounds bounds;
    bounds.update(model, adjacency);
    const double stable = bounds.limit(model, adjacency).stable;
    if (given <= stable) return;
    session.program.said_once.insert("long step");
    Diagnostic d(
        fmt::format("the time step {:.6g} is longer than {:.6g}, up to which it is surely stable", given, stable),
        "it is used, since the highest frequency is estimated to be low enough; the run stops when the account of energy "
        "shows that it is not");
    d.add(session.engine.cycle->time_step_report());
    session.warn(d);
}

void warn_of_fast_spin(Session& session) {
    constexpr double resolved = 0.5; // radians, below which energy is kept to a thousandth
    if (session.program.said_once.contains("fast spin")) return;
    const Model& model = session.engine.model;
    const auto& blocks = model.blocks;
    Row fastest = no_row;
    double most = resolved;
    for (Row b = 0; b < static_cast<Row>(blocks.size()); ++b) {
        if (blocks.deformable[b] || (blocks.fixed[b] & (fix_rx | fix_ry | fix_rz)) != 0) continue;
        const double turn = blocks.rotational_velocity[b].norm() * model.clock.time_step;
        if (turn > most) most = turn, fastest = b;
    }
    if (fastest == no_row) return;
    session.program.said_once.insert("fast spin");
    session.warn(Diagnostic(
        fmt::format("{} turns by {:.3g} radians in a time step: its motion and its energy are not exact",
                    body_text(model, {fastest}), most),
        "a small block with a large load or moment spins like that: change its load, delete it, or give a lower `fraction`"));
}

void note_counted_cycles(Session& session) {
    if (session.engine.model.settings.given_time_step > 0 || !has_velocity_history(session.engine.model)) return;
    session.note_once(
        "cycles are counted while a boundary moves at a given velocity: how far it comes depends on the time step",
        "that of 3DEC for this model is not known, and may be another; `cycle time T` does not depend on it");
}

} // namespace kaya
