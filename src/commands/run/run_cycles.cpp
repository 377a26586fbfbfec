#include "commands/session/autosave.hpp"
#include "commands/run/run_cycles.hpp"

#include "base/counted.hpp"

#include "commands/monitors/failure_monitor.hpp"
#include "commands/monitors/free_fall.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/law_conduct.hpp"
#include "commands/session/materials.hpp"
#include "commands/session/new_contacts.hpp"
#include "commands/session/plausible.hpp"
#include "commands/plot/pictures.hpp"
#include "commands/monitors/progress.hpp"
#include "commands/conditions/tables.hpp"
#include "commands/run/time_step.hpp"
#include "laws/property_roles.hpp"
#include "mechanics/contact/take_over.hpp"
#include "model/edit/stop_motion.hpp"
#include "model/kinds/nearest.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace kaya {

namespace {

void run_deferred(Session& session) {
    while (!session.engine.deferred.empty()) {
        auto changes = std::move(session.engine.deferred);
        session.engine.deferred.clear();
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

/// Foreign laws work between fences in every cycle, or where guard_in_cycle says so.
void fence_laws(JointRegistry& laws, bool always) {
    for (const auto& law : laws.loaded()) law->fence_all_calls(always);
    for (const auto& law : laws.zones.loaded()) law->fence_all_calls(always);
}

/// One cycle and the changes that its hooks deferred. Errors get the cycle and the command that runs it.
void advance(Session& session, bool fenced) {
    struct Inside {
        bool& flag;
        explicit Inside(bool& f) : flag(f) { flag = true; }
        ~Inside() { flag = false; }
    };
    const auto& clock = session.engine.model.clock;
    const std::int64_t number = clock.cycle + 1;
    try {
        {
            const Inside inside(session.engine.inside_cycle);
            fence_laws(session.engine.joints, fenced || session.program.options.strict);
            session.engine.cycle->advance();
        }
        follow_material_table(session);
        review_conduct_in_cycle(session, number);
        run_deferred(session);
        shoot_movies(session);
        session.program.tell_cycled();
    } catch (Diagnostic& failure) {
        session.autosave->step_failed(number, failure.message);
        session.engine.deferred.clear();
        const std::string here = session.deck.here();
        failure.add(fmt::format("in cycle {}, at time {}{}", number, time_text(session.engine.model),
                                here.empty() ? "" : ", run by the command at " + here));
        if (failure.fault == Fault::deck) failure.fault = Fault::run;
        throw;
    }
}

/// Cycles whose stresses are not read may cache them.
class CycleRun {
public:
    explicit CycleRun(Session& session) {
        if (!session.scripts_act_in_cycles() && session.plots.movies.empty() && !session.program.any_listener_reads())
            unwatched_.emplace(*session.engine.cycle);
    }

private:
    std::optional<Cycle::Unwatched> unwatched_;
};

/// A run to a time that less than two steps would cover, as on very soft joints, has shorter ones until its end.
class StepsOfTime {
public:
    StepsOfTime(Session& session, const Limits& limits) : model_(session.engine.model) {
        constexpr double few = 2, enough = 10;
        auto& settings = model_.settings;
        const double step = model_.clock.time_step;
        if (!limits.time || limits.all || settings.given_time_step > 0 || settings.scaled_time_step > 0) return;
        if (!(*limits.time > 0) || step * few <= *limits.time) return;
        before_ = settings.time_step_fraction;
        settings.time_step_fraction = time_step_fraction(settings) * *limits.time / (enough * step);
        ModelEdit(model_, Change::properties);
        session.engine.cycle->prepare();
        if (model_.clock.time_step == step) return; // nothing touches, and gravity alone sets the step
        session.note_once(fmt::format("the time step is {} in a run of {}", number_text(model_.clock.time_step),
                                      number_text(*limits.time)),
                          fmt::format("the usual one, {}, would miss the end", number_text(step)));
    }
    ~StepsOfTime() {
        if (!before_) return;
        model_.settings.time_step_fraction = *before_;
        ModelEdit(model_, Change::properties);
    }
    StepsOfTime(const StepsOfTime&) = delete;
    StepsOfTime& operator=(const StepsOfTime&) = delete;

private:
    Model& model_;
    std::optional<double> before_;
};

/// Joined blocks are all zoned or all rigid; during construction they may be zoned in turn.
void refuse_half_zoned(const Session& session) {
    const auto& blocks = session.engine.model.blocks;
    std::map<std::int32_t, Row> bodies;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.body[b] == 0) continue;
        const Row first = bodies.try_emplace(blocks.body[b], static_cast<Row>(b)).first->second;
        if (blocks.deformable[first] == blocks.deformable[b]) continue;
        const auto [zoned, rigid] =
            blocks.deformable[b] ? std::pair(static_cast<Row>(b), first) : std::pair(first, static_cast<Row>(b));
        throw Diagnostic(
            fmt::format("block {} has zones, and block {}, to which it is joined, has none", blocks.number[zoned],
                        blocks.number[rigid]),
            session.deck.in_words("give zones to both (gen edge ...), or `join off` first",
                                  "give zones to both (block zone generate edgelength ...), or `block join "
                                  "off` first"));
    }
}

/// What each run needs.
void prepare(Session& session) {
    refuse_half_zoned(session);
    check_materials(session);
    check_time_functions(session);
    session.engine.joints.tables().refresh();
    if (!session.engine.model.joint_rules.empty()) find_joints(session);
    session.engine.cycle->prepare();
    if (settle_forces(session)) session.engine.cycle->prepare(); // forces are gathered again
}

/// Throws Diagnostic when steps are so short that the time stops advancing before the end of the run, or now: a double no longer changes.
void refuse_standing_still(const Limits& limits, const Clock& start, const Clock& now) {
    const double time = limits.time ? start.time + *limits.time : now.time;
    if (now.time_step == 0 || time + now.time_step != time) return;
    throw Diagnostic(fmt::format("steps of {} are too short to reach time {}: time would stand still",
                                 number_text(now.time_step), number_text(time)),
                     "something is far too stiff, light or fast: look at stiffnesses, densities, gravity and loads",
                     Fault::run);
}

/// Whether a model at the wanted ratio is at rest: it is observed for some more cycles, in doubled spans while a body moves. A body
/// whose rate is the same after a doubling, or that gains a part of its size, does not come to rest: docs/theory/stopping.md.
class Confirmation {
public:
    /// To be called after each cycle in which the ratio is reached, and with `false` after others.
    enum class Answer { wait, rest, motion };
    /// `whole` has sampled the run from its beginning: a body that moves slowly shows there.
    Answer check(const Model& model, std::int64_t cycles_before, bool ratio_reached,
                 const RestMonitor* whole = nullptr) {
        if (!ratio_reached) {
            monitor_.reset();
            return Answer::wait;
        }
        if (!monitor_) {
            monitor_.emplace(model);
            needed_ = first_check;
            longest_ = std::max(shortest_proof, cycles_before);
            rate_ = INFINITY;
            return Answer::wait;
        }
        monitor_->sample();
        if (monitor_->cycles() < needed_) return Answer::wait;
        moving_ = monitor_->moving();
        if (!moving_ && whole != nullptr) moving_ = whole->moving();
        if (!moving_) return Answer::rest;
        const bool slows = moving_->rate < kept_rate * rate_;
        rate_ = moving_->rate;
        if (moving_->gained > far * block_size(model, moving_->block)) return Answer::motion;
        if (needed_ >= longest_ && (!slows || needed_ >= most_doubled * longest_)) return Answer::motion;
        needed_ *= 2;
        return Answer::wait;
    }
    const std::optional<MovingBody>& moving() const { return moving_; }

private:
    static constexpr std::int64_t first_check = 128, shortest_proof = 2048; ///< cycles
    static constexpr std::int64_t most_doubled = 64; ///< a slowing body gets so many times as long
    static constexpr double kept_rate = 0.98;        ///< of one doubling in the next
    static constexpr double far = 0.01;              ///< of the size of the body
    std::optional<RestMonitor> monitor_;
    std::optional<MovingBody> moving_;
    std::int64_t needed_ = 0, longest_ = 0;
    double rate_ = 0; ///< at the last check
};

/// Reasons for the end of a run: that of the first limit that is reached, or of all of them when all are needed.
class Reasons {
public:
    explicit Reasons(const Limits& limits) : all_(limits.all) {}
    /// Whether further limits must be looked at.
    template <class Text> bool add(bool is_reached, Text text) {
        if (!is_reached) {
            if (all_) text_.clear();
            return !all_;
        }
        text_ += (text_.empty() ? "" : ", ") + text();
        return all_;
    }
    std::string text() const { return text_; }

private:
    bool all_;
    std::string text_;
};

/// Which ratio or force is reached; empty when none is.
std::string equilibrium(const Limits& limits, const Clock& start, const Clock& now) {
    struct Ratio {
        const char* name;
        const std::optional<double>& limit;
        double now;
    };
    if (now.cycle <= start.cycle) return {};
    Reasons reasons(limits);
    for (const Ratio& ratio : {Ratio{"average ratio", limits.ratio, now.average_ratio},
                               Ratio{"maximum ratio", limits.maximum_ratio, now.maximum_ratio},
                               Ratio{"local ratio", limits.local_ratio, now.local_ratio}})
        if (ratio.limit && !reasons.add(ratio.now <= *ratio.limit, [&] {
                return fmt::format("{} {:.3e} is below {}", ratio.name, ratio.now, number_text(*ratio.limit));
            }))
            return reasons.text();
    if (limits.force)
        reasons.add(now.unbalanced_force <= *limits.force, [&] {
            return fmt::format("unbalanced force {} is below {}", number_text(now.unbalanced_force),
                               number_text(*limits.force));
        });
    return reasons.text();
}

/// Whether the next cycle is known to be the last one. Its calls of foreign models are checked in full, whatever the number of cycles.
bool is_last(const Limits& limits, const Clock& start, const Clock& now) {
    return (limits.cycles && now.cycle + 1 - start.cycle >= *limits.cycles) ||
           (limits.time && now.time + 1.5 * now.time_step - start.time >= *limits.time);
}

/// The reason for stopping here; empty to continue.
std::string reached(const Limits& limits, const Clock& start, const Model& model, double seconds) {
    const Clock& now = model.clock;
    Reasons reasons(limits);
    if (limits.cycles &&
        !reasons.add(now.cycle - start.cycle >= *limits.cycles, [&] { return counted(*limits.cycles, "cycle"); }))
        return reasons.text();
    // Half a step of slack: a sum of steps misses the limit by rounding.
    if (limits.time &&
        !reasons.add(now.time - start.time >= *limits.time - 0.5 * now.time_step && now.cycle > start.cycle,
                     [&] { return fmt::format("time {}", time_text(model)); }))
        return reasons.text();
    if (limits.clock)
        reasons.add(seconds >= *limits.clock,
                    [&] { return fmt::format("{} minutes", number_text(*limits.clock / 60)); });
    return reasons.text();
}

/// The end of a run by the reasons why it is at rest and why it stops.
RunEnd run_end(const Limits& limits, std::string at_rest, std::string stops) {
    if (!limits.all) return at_rest.empty() ? RunEnd{std::move(stops)} : RunEnd{std::move(at_rest), true};
    const bool seeks_rest = limits.ratio || limits.maximum_ratio || limits.local_ratio || limits.force;
    const bool stops_itself = limits.cycles || limits.time || limits.clock;
    if ((seeks_rest && at_rest.empty()) || (stops_itself && stops.empty())) return {};
    const bool both = !at_rest.empty() && !stops.empty();
    return {at_rest + (both ? ", and " : "") + stops, !at_rest.empty()};
}

/// The end of a run to equilibrium in which all but the bodies that fall past them have come to rest; checked once in several cycles.
RunEnd end_by_fall(const Limits& limits, const Clock& start, const Model& model) {
    constexpr std::int64_t interval = 64;
    const bool to_equilibrium = limits.ratio || limits.maximum_ratio || limits.local_ratio || limits.force;
    const std::int64_t cycles = model.clock.cycle - start.cycle;
    if (!to_equilibrium || cycles == 0 || cycles % interval != 0) return {};
    const auto fall = free_fall(model);
    if (!fall) return {};
    bool others_rest = !limits.force || fall->force <= *limits.force;
    for (const auto& limit : {limits.ratio, limits.maximum_ratio, limits.local_ratio})
        others_rest = others_rest && (!limit || fall->ratio <= *limit);
    if (!others_rest) return {};
    std::string fallen = body_text(model, {fall->blocks.front()});
    if (const std::size_t more = fall->blocks.size() - 1; more > 0) fallen += " and " + counted(more, "other block");
    return {"the fall of " + fallen, false, fallen};
}

} // namespace

bool settle_forces(Session& session) {
    Model& model = session.engine.model;
    if (model.forces_set.empty() && model.taken_over.empty()) return false;
    if (!model.forces_set.empty()) ModelEdit(model, Change::properties);
    model.taken_over.insert(model.taken_over.end(), model.forces_set.begin(), model.forces_set.end());
    tell_of_forces(model, session.engine.joints);
    for (auto& warning : take_over_forces(model, session.engine.joints)) session.warn(std::move(warning));
    return model.stale.properties();
}

RestSpan advance_span(Session& session, std::int64_t cycles, const RestRatio& ratio, FailureMonitor* monitor,
                      Progress* progress) {
    prepare(session);
    session.autosave->begins();
    const CycleRun run(session);
    RestSpan span;
    const Clock& now = session.engine.model.clock;
    double sum = 0;
    Confirmation confirmation;
    bool at_ratio = false;
    while (span.cycles < cycles || at_ratio) {
        advance(session, false);
        session.stop_after_cycle();
        ++span.cycles;
        sum += ratio.now(now);
        if (progress) progress->advanced();
        at_ratio = ratio.now(now) <= ratio.limit;
        if (monitor && monitor->sample()) {
            span.fails = true;
            break;
        }
        const auto answer = confirmation.check(session.engine.model, cycles, at_ratio);
        span.at_rest = answer == Confirmation::Answer::rest;
        if (answer == Confirmation::Answer::wait) continue;
        if (!span.at_rest) span.moving = confirmation.moving();
        break;
    }
    span.mean_ratio = span.cycles > 0 ? sum / static_cast<double>(span.cycles) : 0;
    return span;
}

void make_ready(Session& session) {
    prepare(session);
    doubt_joints(session);
    doubt_loads(session);
    doubt_zone_magnitudes(session);
    doubt_zone_strengths(session);
    doubt_zone_words(session);
    doubt_water_lines(session);
}

constexpr auto most_cycles = std::numeric_limits<std::int64_t>::max();

RunEnd advance_until(Session& session, const Limits& limits, RestMonitor* monitor) {
    make_ready(session);
    session.autosave->begins();
    warn_of_long_step(session);
    const StepsOfTime steps(session, limits);
    if (monitor) note_added_mass(session);
    if (limits.time) doubt_dynamic_damping(session);
    const Clock start = session.engine.model.clock;
    Target target;
    if (limits.cycles) target.cycle = start.cycle + std::min<std::int64_t>(*limits.cycles, most_cycles - start.cycle);
    if (limits.time) target.time = start.time + *limits.time;

    Progress progress(session.program.output, session.engine.model, target);
    Confirmation confirmation;
    const auto stops = [&](double seconds) -> RunEnd {
        std::string at_rest = equilibrium(limits, start, session.engine.model.clock);
        if (limits.still) {
            const auto answer = confirmation.check(session.engine.model, session.engine.model.clock.cycle - start.cycle,
                                                   !at_rest.empty(), monitor);
            if (answer == Confirmation::Answer::wait) at_rest.clear();
            if (answer == Confirmation::Answer::rest) at_rest += ", and nothing moves";
            if (answer == Confirmation::Answer::motion)
                at_rest +=
                    ", but " + body_text(session.engine.model, *confirmation.moving()) + " does not come to rest";
        }
        if (at_rest.empty())
            if (RunEnd fall = end_by_fall(limits, start, session.engine.model); !fall.why.empty()) return fall;
        return run_end(limits, std::move(at_rest), reached(limits, start, session.engine.model, seconds));
    };
    const CycleRun run(session);
    RunEnd end = stops(0);
    while (end.why.empty()) {
        try {
            refuse_standing_still(limits, start, session.engine.model.clock);
            advance(session, is_last(limits, start, session.engine.model.clock));
            session.stop_after_cycle();
        } catch (...) {
            progress.finish();
            throw;
        }
        if (progress.advanced()) session.autosave->advanced();
        if (monitor) monitor->sample();
        if (limits.calm > 0 && (session.engine.model.clock.cycle - start.cycle) % limits.calm == 0)
            stop_motion(session.engine.model);
        if (limits.ends) end.why = limits.ends();
        if (end.why.empty()) end = stops(progress.seconds());
    }
    progress.finish();
    warn_of_fast_spin(session);
    return end;
}

ElasticJoints::ElasticJoints(Session& session) : session_(session) {
    session.autosave->hold(true);
    for (const auto& set : session.engine.model.joint_properties) true_values_.push_back(set.values);
    for (const Row row : property_sets_in_use(session.engine.model)) {
        auto& set = session.engine.model.joint_properties[row];
        const JointModel& model = session.engine.joints.get(set.model);
        bool breaks = false, raised = false;
        for (std::size_t k = 0; k < model.properties.size(); ++k) {
            const kaya_jrole role = model.properties[k].role;
            const StrengthPart part = strength_part(role);
            breaks = breaks || part != StrengthPart::none;
            // Not residual tension: open joints would be pulled together.
            if (part != StrengthPart::cohesion && role != KAYA_JROLE_TENSION) continue;
            set.values[k] = KAYA_JMODEL_STRONG;
            raised = true;
        }
        strengthened_ = strengthened_ || raised;
        if (breaks && !raised) breakable_.insert(set.model);
    }
}

ElasticJoints::~ElasticJoints() {
    for (std::size_t i = 0; i < true_values_.size(); ++i)
        session_.engine.model.joint_properties[i].values = true_values_[i];
    session_.autosave->hold(false);
}

} // namespace kaya
