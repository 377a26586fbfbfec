// cycle, solve, damp, mscale, fraction.
#include "commands/stability/factor_of_safety.hpp"
#include "commands/review/text_doubts.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/plausible.hpp"
#include "commands/monitors/rest_monitor.hpp"
#include "commands/stability/load_control.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/program/text_table.hpp"
#include "commands/run/time_step.hpp"

#include "mechanics/contact/dashpots.hpp"
#include "mechanics/step/density_scaling.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace kaya {

namespace {

/// "solve: average ratio 9.98e-06 is below 1e-05", "solve: stopped by 5000 cycles"
std::string end_text(std::string_view run, const RunEnd& end) {
    return fmt::format("{}: {}{}", run, end.at_rest ? "" : "stopped by ", end.why);
}

/// Reports how close to rest a run is.
void tell_ratios(Session& session) {
    const Clock& clock = session.engine.model.clock;
    std::string text = fmt::format("average ratio {:.3e}  local ratio {:.3e}", clock.average_ratio, clock.local_ratio);
    if (const auto fastest = fastest_body(session.engine.model))
        text += fmt::format("  largest velocity {} {}", number_text(fastest->speed),
                            body_text(session.engine.model, *fastest));
    session.program.output.say(text);
}

/// The same, and which body does not come to rest in a run that seeks it.
void tell_rest(Session& session, const RestMonitor& monitor, const RunEnd& end, bool still, const Place& place) {
    tell_ratios(session);
    if (!end.fallen.empty()) {
        session.warn(Diagnostic(end.fallen + " left all others: free fall does not come to rest",
                                "fix what should hold it, delete it, or run for a `time`")
                         .at(place));
        return;
    }
    const auto moving = monitor.moving();
    if (!moving) return;
    session.warn(
        Diagnostic(fmt::format("{} does not come to rest: its velocity is {}, and it has gone {} lately",
                               body_text(session.engine.model, *moving), number_text(moving->speed),
                               number_text(moving->gained)),
                   still
                       ? "check its supports, or run more cycles"
                       : "a ratio hardly shows one body among many: with `still` the run continues until no body moves")
            .at(place));
}

Damping damping_of(lang::Damp::Kind kind) {
    switch (kind) {
    case lang::Damp::Kind::none: break;
    case lang::Damp::Kind::local: return Damping::local;
    case lang::Damp::Kind::global: return Damping::global;
    case lang::Damp::Kind::combined: return Damping::combined;
    case lang::Damp::Kind::rayleigh: return Damping::rayleigh;
    }
    return Damping::none;
}

void set_damping(Settings& settings, lang::Damp::Kind kind, const lang::Damp& command) {
    settings.damping = damping_of(kind);
    if (settings.damping == Damping::local || settings.damping == Damping::combined)
        settings.local_factor = command.value.value_or(0.8);
    if (settings.damping == Damping::global && command.value) settings.global_ratio = *command.value;
    if (settings.damping != Damping::rayleigh) return;
    settings.rayleigh_fraction = command.fraction;
    settings.rayleigh_frequency = command.frequency;
    settings.rayleigh_mass = command.mass;
    settings.rayleigh_stiffness = command.stiffness;
}

/// Limits of the whole model, as limits of this run. The nearer one of two counts, or the farther one when all must be reached.
void count_from_now(Limits& limits, const lang::Solve& command, const Clock& clock) {
    const auto take = [&](auto& limit, auto rest) {
        using Number = std::decay_t<decltype(*limit)>;
        rest = std::max<Number>(rest, 0);
        limit = !limit ? rest : limits.all ? std::max<Number>(*limit, rest) : std::min<Number>(*limit, rest);
    };
    if (command.total_cycles) take(limits.cycles, *command.total_cycles - clock.cycle);
    if (command.total_time) take(limits.time, *command.total_time - clock.time);
}

/// Runs with joints that cannot fail; they have their own strength again afterwards.
void solve_elastic(Session& session, const Limits& limits) {
    session.engine.cycle->prepare(); // contacts must have their properties before these can be made strong
    const ElasticJoints strong(session);
    if (!strong.strengthened())
        session.warn(Diagnostic("no joint in use has a cohesion or a tensile strength that could be raised",
                                "'elastic' has no effect"));
    else if (!strong.breakable().empty())
        session.warn(Diagnostic(fmt::format("joints of {} have no cohesion or tensile strength that could be raised",
                                            fmt::join(strong.breakable(), ", ")),
                                "'elastic' has no effect on them"));
    const RunEnd end = advance_until(session, limits);
    session.engine.world.stopped_by = end.why;
    session.program.output.say(end_text("solve elastic", end));
}

} // namespace

/// Fewer cycles are run to inspect the model, not to move a boundary.
constexpr std::int64_t many_cycles = 1000, some_cycles = 100;

void run(Session& session, const lang::CycleCommand& command) {
    doubt_empty_model(session, session.deck.interpreter.current_place());
    if (command.cycles.value_or(0) >= many_cycles) note_counted_cycles(session);
    Limits limits;
    limits.cycles = command.cycles;
    limits.time = command.time;
    limits.calm = command.calm;
    session.engine.world.stopped_by = advance_until(session, limits).why;
    if (command.cycles.value_or(0) >= some_cycles) doubt_gone_blocks(session, session.deck.interpreter.current_place());
}

void run(Session& session, const lang::Solve& command) {
    doubt_empty_model(session, command.place);
    session.engine.run_hooks(script::Moment::solve_start);
    Limits limits{command.cycles, command.time, command.ratio, command.maximum_ratio, command.local_ratio,
                  command.force,  {},           command.still, command.all,           command.calm};
    if (command.clock) limits.clock = *command.clock * 60;
    count_from_now(limits, command, session.engine.model.clock);
    // `solve` looks for equilibrium unless a limit gives another end.
    const bool seeks_rest = command.ratio || command.maximum_ratio || command.local_ratio || command.force;
    if (!seeks_rest && !limits.time && !command.all) limits.ratio = 1e-5;
    if (command.factor_of_safety) return find_factor_of_safety(session, command, limits);
    if (command.elastic) solve_elastic(session, limits);
    if (!command.only) {
        doubt_idle_model(session, command.place);
        if (seeks_rest || limits.ratio) doubt_undamped_search(session, command.place);
        warn_of(session, doubts_of(command));
        RestMonitor monitor(session.engine.model);
        const RunEnd end = advance_until(session, limits, &monitor);
        session.engine.world.stopped_by = end.why;
        session.program.output.say(end_text("solve", end));
        if (seeks_rest || limits.ratio) tell_rest(session, monitor, end, command.still, command.place);
        else tell_ratios(session);
    }
    session.engine.run_hooks(script::Moment::solve_complete);
}

void run(Session& session, const lang::SolveControl& command) {
    doubt_empty_model(session, command.place);
    session.engine.run_hooks(script::Moment::solve_start);
    doubt_idle_model(session, command.place);
    push_over(session, command);
    session.engine.run_hooks(script::Moment::solve_complete);
}

void run(Session& session, const lang::Damp& command) {
    warn_of(session, doubts_of(command));
    auto& model = session.engine.model;
    auto& settings = model.settings;
    const auto stiff_part = [&] {
        return std::tuple(stiffness_damping(settings), settings.contact_damping, time_step_fraction(settings));
    };
    const auto before = stiff_part();
    // A line defines all of the damping; removing dashpots alone leaves the rest unchanged.
    settings.contact_damping = command.contact.value_or(0);
    if (command.kind) set_damping(settings, *command.kind, command);
    else if (settings.contact_damping > 0) settings.damping = Damping::none;
    if (stiff_part() == before) return;
    ModelEdit(model, Change::properties); // the stable step is another
    drop_idle_dashpots(model);
}

void run(Session& session, const lang::MassScale& command) {
    auto& model = session.engine.model;
    auto& settings = model.settings;
    if (command.on && settings.dynamic)
        throw Diagnostic("full density scaling changes the motion, and the model is dynamic",
                         "write 'mscale part dt' for the few bodies with a short time step, or 'set dyn off' before");
    settings.mass_scaling = command.on ? MassScaling::full : command.step ? MassScaling::partial : MassScaling::none;
    settings.scaled_time_step = command.step.value_or(0);
    if (command.off) restore_masses(model);
    ModelEdit(model, Change::properties);
}

void run(Session& session, const lang::Fraction& command) {
    session.engine.model.settings.time_step_fraction = command.value;
    ModelEdit(session.engine.model, Change::properties);
}

void add_handlers(HandlerTable& table, lang::SolutionCommands list) { fill(table, list); }

} // namespace kaya
