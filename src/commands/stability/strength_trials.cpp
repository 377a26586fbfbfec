#include "commands/stability/strength_trials.hpp"

#include "base/counted.hpp"

#include "commands/session/handlers.hpp"
#include "commands/session/materials.hpp"
#include "commands/run/files.hpp"
#include "commands/stability/slip.hpp"

#include "mechanics/zones/cell_motion.hpp"
#include "mechanics/contact/contact_table.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/measure/measure.hpp"
#include "model/kinds/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace kaya {

namespace {

/// Ratio of a model at rest when the command gives none.
constexpr double default_ratio = 1e-5;
/// Cycles after which a model that cannot fail ought to be at rest.
constexpr std::int64_t patience = 100000;
constexpr std::int64_t shortest_span = 100;
/// A trial lowers the strength in this many steps over half a span; a trial from the beginning comes nearly to rest after each.
constexpr int lowering_steps = 10;
constexpr double calm = 1e-3;
/// Spans of one trial: the first after which it may fail, the last where a block has moved by this part of its size, and the last where none
/// has: creep.
constexpr std::size_t first_end = 4, last_end = 12, last_of_creep = 36;
constexpr double far = 0.01;
/// Its unbalanced force falls where the later half of its spans has lost this part: near the limit a block sticks and slips, and the force
/// fluctuates.
constexpr double gain = 0.05;
/// Spans over which a trial is observed for continuing motion.
constexpr double window_part = 2.0 / 3, patient_window_part = 5;
/// A failed model slides on with its strength divided by this additional factor, to save time.
constexpr double shove = 1.1;
constexpr int spans_of_sliding = 3;
/// Dashpots of contacts in trials, of critical damping.
constexpr double dashpots = 0.4;

/// Whether the mean of the later half of the values is smaller than that of as many before.
bool falls(const std::vector<double>& ratios) {
    const auto half = static_cast<std::ptrdiff_t>(ratios.size() / 2);
    const auto middle = ratios.end() - half;
    return std::accumulate(middle, ratios.end(), 0.0) < (1 - gain) * std::accumulate(middle - half, middle, 0.0);
}

bool any_has_moved_far(const Model& start, const Model& model) {
    for (Row b = 0; b < static_cast<Row>(model.blocks.size()); ++b)
        if ((block_displacement(model, b) - block_displacement(start, b)).norm() > far * block_size(model, b))
            return true;
    return false;
}

} // namespace

StrengthTrials::StrengthTrials(Session& session, const lang::Solve& command, const Limits& limits)
    : session_(session), asked_(command), file_(command.file), keep_(command.keep),
      ratio_(limits.ratio.value_or(default_ratio)), energy_(session.model.settings.energy),
      damping_(session.model.settings.damping), dashpots_(session.model.settings.contact_damping),
      progress_(session.output, session.model, {}) {
    session.cycle->prepare(); // contacts must have their properties
    check_strengths(command.place);
    if (session.model.settings.damping == Damping::none)
        throw Diagnostic("without damping a model never comes to rest, and no factor of safety can be found",
                         "write before it, for example: damp local")
            .at(command.place);
    // Local damping holds back sliding bodies (docs/theory/damping.md); no damping of bodies stops vibrations excited by friction.
    if (damping_ == Damping::local) session.model.settings.damping = Damping::combined;
    session.model.settings.contact_damping = std::max(dashpots_, dashpots);
    start_ = session.model;
    start_.settings.energy = true; // a failing trial is detected by its energy account
    start_.unreduced = static_cast<std::uint8_t>((asked_(Reduced::friction) ? 0 : keep_friction) |
                                                 (asked_(Reduced::cohesion) ? 0 : keep_cohesion) |
                                                 (asked_(Reduced::tension) ? 0 : keep_tension));
    try {
        span_ = command.cycles ? *command.cycles : characteristic_span(command.place);
    } catch (...) {
        leave(start_);
        throw;
    }
    go_back(start_);
}
StrengthTrials::~StrengthTrials() { leave(keep_ && failed_ ? failed_->model : start_); }

bool StrengthTrials::stands(double factor) {
    progress_.expect(fmt::format("strength divided by {:.6g}", factor), seconds_left());
    ++trials_;
    const bool warm = warm_ && stable_ && factor > stable_->factor, from_motion = sliding_.has_value();
    if (from_motion) stop_sliding(factor);
    else go_to(warm ? *stable_ : State{start_, {}, 1});
    // A model that is unstable at present must not begin to slide on the way to more strength.
    const double first = warm ? stable_->factor : factor > 1 ? 1 : 0.5 * factor;
    Outcome outcome;
    std::optional<FailureMode> mode;
    // Step by step: a sudden reduction could push joints past their peak, irreversibly.
    for (int step = 1; step < lowering_steps && !outcome.tired && !from_motion; ++step) {
        const double lowered = first * std::pow(factor / first, static_cast<double>(step) / lowering_steps);
        lower(lowered);
        if (warm_) outcome.cycles += run(std::max<std::int64_t>(1, span_ / (2 * lowering_steps)), 0).cycles;
        else {
            mode.emplace(session_.model, *session_.cycle); // it may fail on the way
            settle(outcome, lowered, calm, nullptr);
        }
    }
    if (!outcome.tired) {
        lower(factor);
        session_.cycle->prepare();
        mode.emplace(session_.model, *session_.cycle);
        FailureMonitor monitor(
            session_.model, *session_.cycle,
            static_cast<std::int64_t>((patient_ ? patient_window_part : window_part) * static_cast<double>(span_)));
        settle(outcome, factor, ratio_, goes_to_its_end() ? nullptr : &monitor);
    }
    keep_end(outcome, factor, mode);
    return outcome.at_rest;
}

/// Reports the trial and keeps its end state for later trials.
void StrengthTrials::keep_end(const Outcome& outcome, double factor, const std::optional<FailureMode>& mode) {
    session_.output.say(fmt::format("strength divided by {:.6g}: {} after {}, ratio {:.3e}{}", factor,
                                    outcome.at_rest ? "stands" : "fails", counted(outcome.cycles, "cycle"),
                                    session_.model.clock.average_ratio,
                                    outcome.moving    ? "; " + body_text(session_.model, *outcome.moving) + " moves on"
                                    : outcome.goes_on ? "; it keeps moving and does not slow down"
                                                      : ""));
    if (!outcome.at_rest && !file_.empty()) save_as(session_, file_);
    if (outcome.at_rest) {
        if (!stable_ || factor > stable_->factor) {
            lower(factor); // what is new
            stable_ = State{session_.model, whole_, factor};
        }
    } else {
        mechanism_ = farthest_text(start_, session_.model, factor);
        mode_.reset();
        if (mode) mode_ = mode->shares(session_.model, *session_.cycle);
        failed_early_ = outcome.goes_on;
        failed_ = State{session_.model, whole_, factor};
    }
}

void StrengthTrials::begin_anew() {
    warm_ = false, patient_ = true;
    if (!slides_without_trace()) sliding_.reset();
}

RestSpan StrengthTrials::run(std::int64_t cycles, double ratio, FailureMonitor* monitor) {
    return advance_span(session_, cycles, ratio, monitor, &progress_);
}

/// Cycles until the model is at rest or fails.
void StrengthTrials::settle(Outcome& outcome, double factor, double ratio, FailureMonitor* monitor) {
    std::vector<double> ratios; // means of spans
    const std::size_t first = goes_to_its_end() ? last_end : first_end;
    const auto last = [&] { return any_has_moved_far(start_, session_.model) ? last_end : last_of_creep; };
    while (ratios.size() < first || (falls(ratios) && ratios.size() < last())) {
        if (session_.model.joint_properties.size() > whole_.size()) lower(factor);
        const RestSpan span = run(span_, ratio, monitor);
        outcome.cycles += span.cycles;
        outcome.at_rest = span.at_rest, outcome.goes_on = span.fails, outcome.moving = span.moving;
        if (span.at_rest || span.moving || span.fails) return;
        ratios.push_back(span.mean_ratio);
    }
    outcome.tired = true;
}

/// A bolt across a slipping joint is far softer than a span accounts for: how long a block keeps moving is unknown.
bool StrengthTrials::goes_to_its_end() const { return patient_ && session_.model.structures.stand(); }

void StrengthTrials::go_to(const State& state) {
    go_back(state.model);
    whole_ = state.whole;
}

/// Lets the model slide on from the end of the last trial that failed, with less strength, until shear that loading had locked into
/// its joints has turned into the direction of slip. Whether it did without toppling, and neither joints nor zones are weaker or stronger by it.
bool StrengthTrials::slides_without_trace() {
    if (!failed_ || start_.structures.stand()) return false; // bolts take up load during motion
    for (const Row row : property_sets_in_use(session_.model)) {
        const auto& set = session_.model.joint_properties[row];
        if (loses_strength(session_.joints.get(set.model), set.values)) return false;
    }
    go_to(*failed_);
    lower(shove * failed_->factor);
    session_.cycle->prepare();
    const FailureMode mode(session_.model, *session_.cycle);
    const Slip slip(session_.model);
    for (int i = 0; i < spans_of_sliding && !slip.has_turned_shear(session_.model); ++i) run(span_, 0);
    if (!slip.has_turned_shear(session_.model) || mode.shares(session_.model, *session_.cycle).topples()) return false;
    sliding_ = State{session_.model, whole_, shove * failed_->factor};
    slipping_ = slip.rows(session_.model);
    return answer_of_next_cycle(false) == answer_of_next_cycle(true);
}

/// Forces and stresses one cycle after sliding_, when joints and zones remember it or not.
StrengthTrials::Answer StrengthTrials::answer_of_next_cycle(bool forgets) {
    go_to(*sliding_);
    if (forgets) forget_slip(session_.model, start_, session_.joints);
    ModelEdit(session_.model, Change::properties);
    run(1, 0);
    const auto& subs = session_.model.sub_contacts;
    return {subs.normal_force, subs.shear_force.component, session_.model.zones.stress};
}

/// The model as it has slid, but at rest, and with the shear that slipping joints have with their strength divided by the factor.
void StrengthTrials::stop_sliding(double factor) {
    go_to(*sliding_);
    Model& model = session_.model;
    model.gridpoints.velocity = start_.gridpoints.velocity;
    model.blocks.velocity = start_.blocks.velocity;
    model.blocks.rotational_velocity = start_.blocks.rotational_velocity;
    model.blocks.angular_momentum = start_.blocks.angular_momentum;
    for (auto& column : model.sub_contacts.shear_force.component)
        for (const Row row : slipping_) column[row] *= sliding_->factor / factor;
}

/// At the rate of the trials so far; none where that is unknown.
std::optional<double> StrengthTrials::seconds_left() const {
    if (trials_ == 0 || expected_ == 0) return std::nullopt;
    return progress_.seconds() / trials_ * expected_;
}

/// Sets all strengths to the initial ones divided by the factor.
void StrengthTrials::lower(double factor) {
    learn_whole_values();
    auto& sets = session_.model.joint_properties;
    if (asked_(Reduced::joints))
        for (std::size_t i = 0; i < sets.size(); ++i)
            if (const auto values = reduced(session_.joints.get(sets[i].model), whole_[i], factor, asked_))
                sets[i].values = *values;
    session_.model.settings.strength_factor = asked_(Reduced::zones) ? factor : 1;
    ModelEdit(session_.model, Change::properties);
}

/// Contacts that are new in a trial get the values of their material, which are whole.
void StrengthTrials::learn_whole_values() {
    const auto& sets = session_.model.joint_properties;
    while (whole_.size() < sets.size()) whole_.push_back(sets[whole_.size()].values);
}

/// The model as the command leaves it.
void StrengthTrials::leave(const Model& state) {
    go_back(state);
    session_.model.unreduced = 0;
    session_.model.settings.energy = energy_;
    session_.model.settings.damping = damping_;
    session_.model.settings.contact_damping = dashpots_;
    drop_idle_dashpots(session_.model);
}

void StrengthTrials::go_back(const Model& state) {
    session_.model = state;
    ModelEdit(session_.model, Change::lists);
}

void StrengthTrials::check_strengths(const Place& place) {
    std::string without;
    bool any = false;
    if (asked_(Reduced::joints))
        for (const Row row : property_sets_in_use(session_.model)) {
            const auto& set = session_.model.joint_properties[row];
            const JointModel& joint = session_.joints.get(set.model);
            const bool strong = reduced(joint, set.values, 1, asked_).has_value();
            any = any || strong;
            if (!strong) without = joint.name;
            if (auto doubt = doubtful_tension(joint, set)) session_.warn(std::move(*doubt).at(place));
        }
    for (const auto& name : zone_models_in_use(session_.model)) {
        const ZoneModel& zones = session_.joints.zones.get(name);
        any = any || (can_be_reduced(zones) && asked_(Reduced::zones));
        if (asked_(Reduced::zones) && zones.flows() && !can_be_reduced(zones))
            session_.warn(Diagnostic(fmt::format("zone model '{}' has no strength that could be divided", name),
                                     "its strength is unchanged in all trials")
                              .at(place));
    }
    if (!any)
        throw Diagnostic(without.empty()
                             ? "there is no joint whose strength could be divided"
                             : fmt::format("joint model '{}' has no strength that could be divided", without),
                         "a factor of safety needs joints with friction, cohesion or tension")
            .at(place);
    if (!without.empty())
        session_.warn(Diagnostic(fmt::format("joint model '{}' has no friction, cohesion or tension", without),
                                 "its strength is unchanged in all trials")
                          .at(place));
}

/// The number of cycles in which the model comes to rest when half of all its inner forces are removed and nothing can fail.
std::int64_t StrengthTrials::characteristic_span(const Place& place) {
    Model& model = session_.model;
    const ElasticJoints strong(session_);
    model.settings.strength_factor = 0.01; // zones a hundred times as strong do not yield
    for (double& force : model.sub_contacts.normal_force) force *= 0.5;
    for (auto& column : model.sub_contacts.shear_force.component)
        for (double& force : column) force *= 0.5;
    scale_zone_stresses(model, ZoneLaws(model, session_.joints.zones), 0.5);
    initialise_sub_contacts(model, session_.joints, std::vector<char>(model.sub_contacts.size(), 1));
    ModelEdit(model, Change::properties);
    progress_.expect("how long the model takes to come to rest", std::nullopt);
    const RestSpan span = run(patience, ratio_);
    if (span.at_rest) return std::max(span.cycles, shortest_span);
    throw Diagnostic(
        fmt::format("with joints that cannot fail the model is not at rest after {} cycles: the ratio is {:.3e}",
                    span.cycles, model.clock.average_ratio),
        "hold it so that only joints can let it go, or give a larger `ratio`, or the `cycles` of a span")
        .at(place);
}

} // namespace kaya
