// new, config, title, pause, set, range name.
#include "commands/session/autosave.hpp"
#include "commands/session/handlers.hpp"

#include "base/lower_case.hpp"
#include "base/parallel.hpp"
#include "commands/session/plausible.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/common/property_sets.hpp"
#include "model/measure/compatibility.hpp"
#include "system/keyboard.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace kaya {

namespace {

void refuse_scaled_dynamics(const Session& session) {
    if (session.engine.model.settings.mass_scaling == MassScaling::full)
        throw Diagnostic("full density scaling changes the motion, and the model is to be dynamic",
                         "write 'mscale off' or 'mscale part dt' before");
}

/// Dynamic runs start without damping, static ones with the default; a previous `damp` stays in force.
void set_dynamic(Session& session, bool on) {
    auto& settings = session.engine.model.settings;
    if (on == settings.dynamic) return;
    settings.dynamic = on;
    ModelEdit(session.engine.model, Change::properties); // the fraction of the stable step may change
    const Settings fresh;
    const bool is_default = settings.damping == fresh.damping && settings.local_factor == fresh.local_factor;
    if (on && is_default) settings.damping = Damping::none;
    if (!on && settings.damping == Damping::none) {
        settings.damping = fresh.damping;
        settings.local_factor = fresh.local_factor;
    }
}

/// A step that is too long for the model of now is refused now; later ones are checked as the model changes.
void give_time_step(Session& session, double step) {
    auto& model = session.engine.model;
    const double before = model.settings.given_time_step;
    model.settings.given_time_step = step;
    if (!model.blocks.empty() && model.clock.time_step > 0 && !model.stale.properties() && !model.stale.contacts()) {
        try {
            ModelEdit(model, Change::properties);
            session.engine.cycle->prepare();
        } catch (...) {
            model.settings.given_time_step = before;
            throw;
        }
    }
    ModelEdit(model, Change::properties);
}

/// Rigid blocks that have a spacing of sub-contacts keep it.
void set_compatibility(Model& model, bool with_3dec) {
    auto& blocks = model.blocks;
    const double before = with_3dec ? 0 : at_corners_only, after = with_3dec ? at_corners_only : 0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (!blocks.deformable[b] && blocks.face_edge[b] == before) blocks.face_edge[b] = after;
    if (as_3dec(model.settings) != with_3dec) model.settings.given_time_step = with_3dec ? step_of_3dec_wanted : 0;
    model.clock.time_step = 0;
    ModelEdit(model, Change::surfaces);
}

void set_log(Session& session, const lang::Set& command) {
    Output& output = session.program.output;
    const bool on = command.log.value_or(output.logging());
    if (command.log_file) session.program.log_file = *command.log_file;
    if (command.empty_log) output.empty_log(session.program.output_file(session.program.log_file));
    if (on) output.start_log(session.program.output_file(session.program.log_file));
    else output.stop_log();
}

} // namespace

void run(Session& session, const lang::New&) { session.clear(); }

void run(Session& session, const lang::Config& command) {
    if (!command.dynamic) return;
    refuse_scaled_dynamics(session);
    set_dynamic(session, true);
}

void run(Session& session, const lang::Title& command) { session.deck.title = command.text; }

void run(Session&, const lang::ReadDialect&) {}

void run(Session& session, const lang::Pause&) {
    // A background run that reads its commands from a file cannot be continued by a key.
    if (session.program.output.quiet || !session.program.output.on_terminal() || !has_keyboard()) return;
    session.program.output.say("pause: press Enter to continue");
    auto pressed = read_key();
    while (pressed && *pressed != '\n' && *pressed != '\r' && *pressed != key::interrupt) pressed = read_key();
    if (pressed == key::interrupt) session.interrupt();
    session.stop_if_interrupted();
}

void run(Session& session, const lang::Set& command) {
    auto& settings = session.engine.model.settings;
    if (command.dynamic.value_or(false)) refuse_scaled_dynamics(session);
    if (command.default_joint_constitutive) {
        const auto number = static_cast<std::int32_t>(*command.default_joint_constitutive);
        (void)joint_model_of_number(session.engine.model, number); // throws when there is none
        settings.default_joint_constitutive = number;
    }
    if (command.default_joint_material)
        settings.default_joint_material = static_cast<std::int32_t>(*command.default_joint_material);
    if (command.dynamic) set_dynamic(session, *command.dynamic);
    if (command.small) {
        settings.large_strain = !*command.small;
        ModelEdit(session.engine.model, Change::properties);
    }
    if (command.time_step_fraction) {
        settings.time_step_fraction = *command.time_step_fraction;
        ModelEdit(session.engine.model, Change::properties);
    }
    if (command.time_step) give_time_step(session, *command.time_step);
    if (command.as_3dec) set_compatibility(session.engine.model, *command.as_3dec);
    if (command.threads) session.program.set_threads(static_cast<int>(std::max<std::int64_t>(1, *command.threads)));
    if (command.echo) session.program.options.echo = *command.echo;
    if (command.autosave)
        session.autosave->set_interval(*command.autosave > 0 ? std::optional(60 * *command.autosave) : std::nullopt);
    if (command.report) session.program.report = *command.report;
    if (command.gravity) settings.gravity = *command.gravity;
    if (command.units) {
        session.deck.units = Units(*command.units);
        doubt_units(session);
    }
    if (command.seed) session.engine.scripts->seed(static_cast<std::uint64_t>(*command.seed));
    if (command.log_file || command.log) set_log(session, command);
    for (const auto& [name, value] : command.fish) {
        const auto scripted = std::visit([](const auto& v) { return script::Value(v); }, value);
        session.engine.scripts->set(name, scripted, session.deck.interpreter.current_place());
    }
}

void run(Session& session, const lang::NameRange& command) {
    const std::string name = lower_case(command.name);
    if (!command.remove) session.deck.ranges[name] = command.range;
    else if (session.deck.ranges.erase(name) == 0)
        throw Diagnostic(fmt::format("there is no range named '{}'", command.name), "list ranges shows them");
}

void add_handlers(HandlerTable& table, lang::ControlCommands list) { fill(table, list); }

} // namespace kaya
