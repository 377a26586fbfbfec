// cycle, solve, damp, mscale, fraction.
#include "commands/handlers.hpp"
#include "commands/materials.hpp"
#include "commands/progress.hpp"
#include "commands/tables.hpp"

#include "mechanics/dashpots.hpp"
#include "mechanics/phases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

namespace {

/// Where a run stops: at the first of these that is reached.
struct Limits {
    std::optional<std::int64_t> cycles; ///< from now on
    std::optional<double> time;         ///< from now on
    std::optional<double> ratio, maximum_ratio, local_ratio, force;
    std::optional<double> clock; ///< seconds
};

void run_deferred(Session& session) {
    while (!session.deferred.empty()) {
        auto changes = std::move(session.deferred);
        session.deferred.clear();
        for (auto& [place, change] : changes) {
            try {
                change();
            } catch (Diagnostic& mistake) {
                mistake.at(place);
                throw;
            }
        }
    }
}

/// One cycle and what its hooks put off. Errors get the cycle, and the command that runs it.
void advance(Session& session) {
    struct Inside {
        bool& flag;
        explicit Inside(bool& f) : flag(f) { flag = true; }
        ~Inside() { flag = false; }
    };
    const auto& clock = session.model.clock;
    const std::int64_t number = clock.cycle + 1;
    try {
        {
            const Inside inside(session.inside_cycle);
            session.cycle->advance();
        }
        run_deferred(session);
    } catch (Diagnostic& failure) {
        session.deferred.clear();
        const std::string here = session.here();
        failure.add(fmt::format("in cycle {}, at time {}{}", number, time_text(session.model),
                                here.empty() ? "" : ", run by the command at " + here));
        if (failure.fault == Fault::deck) failure.fault = Fault::run;
        throw;
    }
}

/// Why the run stops here; empty when it goes on.
std::string reached(const Limits& limits, const Clock& start, const Model& model, double seconds) {
    const Clock& now = model.clock;
    struct Ratio {
        const char* name;
        const std::optional<double>& limit;
        double now;
    };
    for (const Ratio& ratio : {Ratio{"ratio", limits.ratio, now.average_ratio},
                               Ratio{"maximum ratio", limits.maximum_ratio, now.maximum_ratio},
                               Ratio{"local ratio", limits.local_ratio, now.local_ratio}})
        if (ratio.limit && now.cycle > start.cycle && ratio.now <= *ratio.limit)
            return fmt::format("the {} {:.3e} is not above {}", ratio.name, ratio.now, number_text(*ratio.limit));
    if (limits.force && now.cycle > start.cycle && now.unbalanced_force <= *limits.force)
        return fmt::format("the unbalanced force {} is not above {}", number_text(now.unbalanced_force),
                           number_text(*limits.force));
    if (limits.cycles && now.cycle - start.cycle >= *limits.cycles)
        return fmt::format("{} cycles", *limits.cycles);
    // Half a step of slack: a sum of steps misses the limit by rounding.
    if (limits.time && now.time - start.time >= *limits.time - 0.5 * now.time_step && now.cycle > start.cycle)
        return fmt::format("time {}", time_text(model));
    if (limits.clock && seconds >= *limits.clock)
        return fmt::format("{} minutes", number_text(*limits.clock / 60));
    return {};
}

/// Runs until a limit is reached; returns which, in words.
std::string advance_until(Session& session, const Limits& limits) {
    check_materials(session);
    check_time_functions(session);
    session.joints.tables().refresh();
    session.cycle->prepare();
    const Clock start = session.model.clock;
    Target target;
    if (limits.cycles) target.cycle = start.cycle + *limits.cycles;
    if (limits.time) target.time = start.time + *limits.time;

    Progress progress(session.output, session.model, target);
    std::string why = reached(limits, start, session.model, 0);
    while (why.empty()) {
        try {
            advance(session);
            session.stop_behind_cycle();
        } catch (...) {
            progress.finish();
            throw;
        }
        progress.advanced();
        why = reached(limits, start, session.model, progress.seconds());
    }
    progress.finish();
    return why;
}

/// Gives joints a cohesion and a tensile strength that nothing reaches, for as long as it lives.
class ElasticJoints {
public:
    explicit ElasticJoints(Session& session) : session_(session) {
        for (const auto& set : session.model.joint_properties) true_values_.push_back(set.values);
        constexpr double strong = 1e30;
        for (const Row row : property_sets_in_use(session.model)) {
            auto& set = session.model.joint_properties[row];
            const JointModel& model = session.joints.get(set.model);
            for (const char* word : {"jcohesion", "jtension"})
                if (const auto index = model.find_property(word)) {
                    set.values[*index] = strong;
                    strengthened_ = true;
                }
        }
    }
    ~ElasticJoints() {
        for (std::size_t i = 0; i < true_values_.size(); ++i)
            session_.model.joint_properties[i].values = true_values_[i];
    }
    ElasticJoints(const ElasticJoints&) = delete;
    ElasticJoints& operator=(const ElasticJoints&) = delete;

    /// False when no joint model has such a strength: the first run is then like the second.
    bool strengthened() const { return strengthened_; }

private:
    bool strengthened_ = false;
    Session& session_;
    std::vector<std::vector<double>> true_values_;
};

struct DampingEntry {
    std::string_view word;
    Damping damping;
};
constexpr std::array<DampingEntry, 6> dampings{{
    {"auto", Damping::global},
    {"global", Damping::global},
    {"local", Damping::local},
    {"combined", Damping::combined},
    {"rayleigh", Damping::rayleigh},
    {"none", Damping::none},
}};

void set_damping(Settings& settings, const lang::Damp& command) {
    const auto found = std::ranges::find(dampings, std::string_view(command.kind), &DampingEntry::word);
    if (found == dampings.end()) throw std::logic_error("damp: no entry for '" + command.kind + "'");
    settings.damping = found->damping;
    if (found->damping == Damping::local || found->damping == Damping::combined)
        settings.local_factor = command.value.value_or(0.8);
    if (found->damping == Damping::global && command.value) settings.global_ratio = *command.value;
    if (found->damping != Damping::rayleigh) return;
    settings.rayleigh_fraction = command.fraction;
    settings.rayleigh_frequency = command.frequency;
    settings.rayleigh_mass = command.mass;
    settings.rayleigh_stiffness = command.stiffness;
}

} // namespace

void run(Session& session, const lang::CycleCommand& command) {
    Limits limits;
    limits.cycles = command.cycles;
    limits.time = command.time;
    advance_until(session, limits);
}

void run(Session& session, const lang::Solve& command) {
    Limits limits{command.cycles, command.time, command.ratio, command.maximum_ratio, command.local_ratio,
                  command.force, {}};
    if (command.clock) limits.clock = *command.clock * 60;
    // Equilibrium is what `solve` looks for unless a limit says what else to wait for.
    if (!command.ratio && !command.maximum_ratio && !command.local_ratio && !command.force && !command.time) limits.ratio = 1e-5;
    if (command.elastic) {
        session.cycle->prepare(); // contacts must have their properties before these can be made strong
        const ElasticJoints strong(session);
        if (!strong.strengthened())
            session.warn(
                Diagnostic("no joint in use has a cohesion or a tensile strength that could be raised",
                           "'elastic' has no effect"));
        session.output.say("solve elastic: stopped by " + advance_until(session, limits));
    }
    session.output.say("solve: stopped by " + advance_until(session, limits));
}

void run(Session& session, const lang::Damp& command) {
    auto& model = session.model;
    auto& settings = model.settings;
    const auto stiff_part = [&] { return std::pair(stiffness_damping(settings), settings.contact_damping); };
    const auto before = stiff_part();
    if (command.contact) settings.contact_damping = *command.contact;
    if (!command.kind.empty()) set_damping(settings, command);
    if (stiff_part() == before) return;
    model.properties_changed = true; // the stable step is another
    if (joints_are_damped(settings)) return;
    std::ranges::fill(model.sub_contacts.dashpot_normal, 0.0);
    for (auto& column : model.sub_contacts.dashpot_shear.component) std::ranges::fill(column, 0.0);
    std::ranges::fill(model.zones.dashpot, Stress::Zero());
}

void run(Session& session, const lang::MassScale& command) {
    auto& model = session.model;
    auto& settings = model.settings;
    if (command.on && settings.dynamic)
        throw Diagnostic("full density scaling changes the motion, and the model is dynamic",
                         "write 'mscale part dt' for the few bodies with a short time step, or 'set dyn off' before");
    settings.mass_scaling = command.on     ? MassScaling::full
                            : command.step ? MassScaling::partial
                                           : MassScaling::none;
    settings.scaled_time_step = command.step.value_or(0);
    if (command.off) restore_masses(model);
    model.properties_changed = true;
}

void run(Session& session, const lang::Fraction& command) {
    session.model.settings.time_step_fraction = command.value;
    session.model.properties_changed = true;
}

} // namespace kaya
