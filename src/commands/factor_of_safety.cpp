#include "commands/factor_of_safety.hpp"

#include "commands/save_session.hpp"

#include "base/counted.hpp"

#include "commands/failure_mode.hpp"
#include "commands/failure_monitor.hpp"
#include "commands/handlers.hpp"
#include "commands/materials.hpp"
#include "commands/progress.hpp"
#include "commands/slip.hpp"
#include "commands/stability.hpp"
#include "commands/strength_reduction.hpp"

#include "mechanics/contact_table.hpp"
#include "mechanics/zone_laws.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>
#include <utility>

namespace kaya {

namespace {

/// Below this the model counts as at rest when the command does not say.
constexpr double default_ratio = 1e-5;
/// Cycles after which a model that cannot fail ought to be at rest.
constexpr std::int64_t patience = 100000;
constexpr std::int64_t shortest_span = 100;
/// A trial lowers the strength in so many steps, over half a span; one that begins anew comes nearly to rest after each.
constexpr int lowering_steps = 10;
constexpr double calm = 1e-3;
/// Spans that one trial may take, the part of its unbalanced force that each should take away, and how many in a row may
/// fail to: near the limit a block sticks and slips, and the force goes up and down.
constexpr int spans = 12;
constexpr double gain = 0.1;
constexpr int most_without_gain = 2;
/// Spans over which a trial is watched for motion that goes on.
constexpr double window_part = 2.0 / 3, patient_window_part = 2;
/// A model that has failed slides on with its strength divided by so much more, so that it does not take long.
constexpr double shove = 1.1;
constexpr int spans_of_sliding = 3;
constexpr double turned_part = 0.9; ///< where it stands only with less of its factor, it has not only slid, but turned
constexpr double largest = 64;      ///< factors beyond which nobody looks
/// A bracket that begins with a guess has this half width, and is widened so many times as much each time.
constexpr double first_width = 0.03, widening = 4;

/// Trials of one model; each begins with the model as it was in the beginning, and so does what comes after the last.
class Trials {
public:
    Trials(Session& session, const lang::Solve& command, const Limits& limits)
        : session_(session), asked_(command), file_(command.file), keep_(command.keep),
          ratio_(limits.ratio.value_or(default_ratio)), progress_(session.output, session.model, {}) {
        session.cycle->prepare(); // contacts must have their properties
        check_strengths(command.place);
        if (session.model.settings.damping == Damping::none)
            throw Diagnostic("without damping a model never comes to rest, and no factor of safety can be found",
                             "write before it, for example: damp local")
                .at(command.place);
        // Local damping holds back what slides on (docs/theory/damping.md).
        if (damping_ == Damping::local) session.model.settings.damping = Damping::combined;
        start_ = session.model;
        start_.settings.energy = true; // a failing trial is known by its account
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
    ~Trials() { leave(keep_ && failed_ ? failed_->model : start_); }
    Trials(const Trials&) = delete;
    Trials& operator=(const Trials&) = delete;

    /// Whether the model comes to rest with its strength divided by the factor. It stands when the ratio is reached; it
    /// fails when its unbalanced force does not get smaller from one span to the next. Begins where the last trial that
    /// stood with less came to rest, or where the first one began.
    bool stands(double factor) {
        progress_.expect(fmt::format("strength divided by {:.6g}", factor), seconds_left());
        ++trials_;
        const bool warm = warm_ && stable_ && factor > stable_->factor, from_motion = sliding_.has_value();
        if (from_motion) stop_sliding(factor);
        else go_to(warm ? *stable_ : State{start_, {}, 1});
        // A model that does not stand as it is must not begin to slide on the way to more strength.
        const double first = warm ? stable_->factor : factor > 1 ? 1 : 0.5 * factor;
        Outcome outcome;
        // Step by step: joints that are past their peak do not get it back, and a blow carries them over it.
        for (int step = 1; step < lowering_steps && !outcome.tired && !from_motion; ++step) {
            const double lowered = first * std::pow(factor / first, static_cast<double>(step) / lowering_steps);
            lower(lowered);
            if (warm_) outcome.cycles += run(std::max<std::int64_t>(1, span_ / (2 * lowering_steps)), 0).cycles;
            else settle(outcome, lowered, calm, nullptr);
        }
        std::optional<FailureMode> mode;
        if (!outcome.tired) {
            lower(factor);
            session_.cycle->prepare();
            mode.emplace(session_.model, *session_.cycle);
            FailureMonitor monitor(
                session_.model, *session_.cycle,
                static_cast<std::int64_t>((patient_ ? patient_window_part : window_part) * static_cast<double>(span_)));
            // A bolt across a joint that slips is far softer than all that a span knows: nobody can tell how long a block goes on.
            settle(outcome, factor, ratio_, patient_ && !session_.model.structures.cables.empty() ? nullptr : &monitor);
        }
        const bool at_rest = outcome.at_rest;
        session_.output.say(fmt::format("strength divided by {:.6g}: {} after {}, ratio {:.3e}{}", factor,
                                        at_rest ? "stands" : "fails", counted(outcome.cycles, "cycle"),
                                        session_.model.clock.average_ratio,
                                        outcome.moving ? "; " + body_text(session_.model, *outcome.moving) + " moves on"
                                        : outcome.goes_on ? "; it moves on and does not slow down"
                                                          : ""));
        if (!at_rest && !file_.empty()) save_as(session_, file_);
        if (at_rest) {
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
        return at_rest;
    }

    /// How many more trials there will be, for the person who waits.
    void expect(int more) { expected_ = more; }
    /// Whether the last trial that failed was ended because motion went on.
    bool failed_early() const { return failed_early_; }
    /// From now on trials are watched over three times as many cycles before they end early.
    void be_patient() { patient_ = true; }
    /// From now on no trial ends in haste, and each begins where the first one did; or, where joints and zones remember nothing of
    /// their motion, with the forces that it has left behind.
    void begin_anew() {
        warm_ = false, patient_ = true;
        if (!slides_without_trace()) sliding_.reset();
    }
    /// Whether trials begin where the model has slid on to.
    bool slides() const { return sliding_.has_value(); }
    void forget_sliding() { sliding_.reset(); }
    /// Whether the last trial that stood began anywhere else than the first.
    bool has_warm_answer() const { return warm_ && stable_.has_value(); }
    /// What moved in the last trial that failed; "" when none did.
    const std::string& mechanism() const { return mechanism_; }
    /// How that trial failed; none where it did on the way to its factor.
    const std::optional<FailureMode::Shares>& mode() const { return mode_; }

private:
    RestSpan run(std::int64_t cycles, double ratio, FailureMonitor* monitor = nullptr) {
        return advance_span(session_, cycles, ratio, monitor, &progress_);
    }

    /// How a trial stands so far.
    struct Outcome {
        std::int64_t cycles = 0;
        bool at_rest = false, tired = false, goes_on = false; ///< tired: the force out of balance does not get smaller
        std::optional<MovingBody> moving;
    };

    /// Cycles until the model is at rest or fails.
    void settle(Outcome& outcome, double factor, double ratio, FailureMonitor* monitor) {
        double least = INFINITY;
        for (int i = 0, without_gain = 0; i < spans && without_gain <= most_without_gain; ++i) {
            if (session_.model.joint_properties.size() > whole_.size()) lower(factor);
            const RestSpan span = run(span_, ratio, monitor);
            outcome.cycles += span.cycles;
            outcome.at_rest = span.at_rest, outcome.goes_on = span.fails, outcome.moving = span.moving;
            if (span.at_rest || span.moving || span.fails) return;
            without_gain = span.mean_ratio > (1 - gain) * least ? without_gain + 1 : 0;
            least = std::min(least, span.mean_ratio);
        }
        outcome.tired = true;
    }

    /// A state that trials begin or end with, and the values of its property sets before they were divided.
    struct State {
        Model model;
        std::vector<std::vector<double>> whole;
        double factor;
    };
    void go_to(const State& state) {
        go_back(state.model);
        whole_ = state.whole;
    }

    /// Lets the model slide on from the end of the last trial that failed, with less strength, until shear that loading had locked into
    /// its joints has turned into the direction of slip. Whether it did, and neither joints nor zones are weaker or stronger by it.
    bool slides_without_trace() {
        if (!failed_ || !start_.structures.cables.empty()) return false; // bolts take up load on the way
        for (const Row row : property_sets_in_use(session_.model)) {
            const auto& set = session_.model.joint_properties[row];
            if (loses_strength(session_.joints.get(set.model), set.values)) return false;
        }
        go_to(*failed_);
        lower(shove * failed_->factor);
        const Slip slip(session_.model);
        for (int i = 0; i < spans_of_sliding && !slip.has_turned_shear(session_.model); ++i) run(span_, 0);
        if (!slip.has_turned_shear(session_.model)) return false;
        sliding_ = State{session_.model, whole_, shove * failed_->factor};
        slipping_ = slip.rows(session_.model);
        return answer_of_next_cycle(false) == answer_of_next_cycle(true);
    }

    /// Forces and stresses one cycle after sliding_, when joints and zones remember it or not.
    using Answer = std::tuple<Column<double>, std::array<Column<double>, 3>, Column<Stress>>;
    Answer answer_of_next_cycle(bool forgets) {
        go_to(*sliding_);
        if (forgets) forget_slip(session_.model, start_, session_.joints);
        ModelEdit(session_.model, Change::properties);
        run(1, 0);
        const auto& subs = session_.model.sub_contacts;
        return {subs.normal_force, subs.shear_force.component, session_.model.zones.stress};
    }

    /// The model as it has slid, but at rest, and with the shear that slipping joints have with their strength divided by the factor.
    void stop_sliding(double factor) {
        go_to(*sliding_);
        Model& model = session_.model;
        model.gridpoints.velocity = start_.gridpoints.velocity;
        model.blocks.velocity = start_.blocks.velocity;
        model.blocks.rotational_velocity = start_.blocks.rotational_velocity;
        model.blocks.angular_momentum = start_.blocks.angular_momentum;
        for (auto& column : model.sub_contacts.shear_force.component)
            for (const Row row : slipping_) column[row] *= sliding_->factor / factor;
    }

    /// At the rate of the trials so far; none where that is not known.
    std::optional<double> seconds_left() const {
        if (trials_ == 0 || expected_ == 0) return std::nullopt;
        return progress_.seconds() / trials_ * expected_;
    }

    /// All strengths are those of the beginning, divided by the factor.
    void lower(double factor) {
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
    void learn_whole_values() {
        const auto& sets = session_.model.joint_properties;
        while (whole_.size() < sets.size()) whole_.push_back(sets[whole_.size()].values);
    }

    /// The model as the command leaves it.
    void leave(const Model& state) {
        go_back(state);
        session_.model.unreduced = 0;
        session_.model.settings.energy = energy_;
        session_.model.settings.damping = damping_;
    }

    void go_back(const Model& state) {
        session_.model = state;
        ModelEdit(session_.model, Change::lists);
    }

    void check_strengths(const Place& place) {
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
                                         "its strength stays as it is in all trials")
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
                                     "its strength stays as it is in all trials")
                              .at(place));
    }

    /// How many cycles the model needs to come to rest when half of all its inner forces are taken away and nothing
    /// can fail.
    std::int64_t characteristic_span(const Place& place) {
        Model& model = session_.model;
        const ElasticJoints strong(session_);
        model.settings.strength_factor = 0.01; // zones a hundred times as strong do not yield
        for (double& force : model.sub_contacts.normal_force) force *= 0.5;
        for (auto& column : model.sub_contacts.shear_force.component)
            for (double& force : column) force *= 0.5;
        for (Stress& stress : model.zones.stress) stress *= 0.5;
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

    Session& session_;
    Asked asked_;
    std::string file_;
    bool keep_;
    double ratio_;
    bool energy_ = session_.model.settings.energy; ///< as the deck has it
    Damping damping_ = session_.model.settings.damping;
    Progress progress_;
    Model start_;
    std::optional<State> stable_, failed_;   ///< ends of trials
    std::optional<State> sliding_;           ///< where the model has slid on to after one that failed
    std::vector<Row> slipping_;              ///< sub-contacts that slip there
    std::vector<std::vector<double>> whole_; ///< of the present state
    bool warm_ = true, patient_ = false, failed_early_ = false;
    std::string mechanism_;
    std::optional<FailureMode::Shares> mode_;
    std::int64_t span_ = 0;
    int trials_ = 0, expected_ = 0;
};

/// Factors where the model stands and where it fails.
struct Bracket {
    double stands, fails;
};

Bracket given_bracket(Trials& trials, const lang::Solve& command) {
    const Bracket bracket{(*command.bracket)[0], (*command.bracket)[1]};
    if (!trials.stands(bracket.stands))
        throw Diagnostic(
            fmt::format("the model fails with its strength divided by {:.6g}, where it should stand", bracket.stands),
            "give a smaller first number after bracket")
            .at(command.place);
    if (trials.stands(bracket.fails))
        throw Diagnostic(
            fmt::format("the model stands with its strength divided by {:.6g}, where it should fail", bracket.fails),
            "give a greater second number after bracket")
            .at(command.place);
    return bracket;
}

/// By doubling and halving; a side that was not found is 0 or infinite.
Bracket found_bracket(Trials& trials) {
    if (trials.stands(1)) {
        for (double factor = 1; factor < largest; factor *= 2)
            if (!trials.stands(2 * factor)) return {factor, 2 * factor};
        return {largest, INFINITY};
    }
    for (double factor = 1; factor > 1 / largest; factor /= 2)
        if (trials.stands(factor / 2)) return {factor / 2, factor};
    return {0, 1 / largest};
}

/// From a guess outward; a side that was not found is 0 or infinite.
Bracket bracket_around(Trials& trials, double guess) {
    double width = first_width;
    Bracket bracket{guess * (1 - width), guess * (1 + width)};
    if (trials.stands(bracket.stands)) {
        for (; bracket.fails < largest; width *= widening, bracket.stands = bracket.fails, bracket.fails *= 1 + width)
            if (!trials.stands(bracket.fails)) return bracket;
        return {bracket.stands, INFINITY};
    }
    for (bracket.fails = bracket.stands; bracket.fails > 1 / largest; bracket.fails = bracket.stands) {
        width = std::min(0.5, width * widening);
        bracket.stands = bracket.fails * (1 - width);
        if (trials.stands(bracket.stands)) return bracket;
    }
    return {0, bracket.fails};
}

/// What is known before the first trial: the factor of the weakest block by block theory, else the one that `limit equilibrium` or an
/// earlier search has found. 0 where neither is there.
double guessed_factor(Session& session) {
    constexpr double least = 0.1, most = 10;
    double guess = INFINITY;
    for (const BodyStability& body : stability_of(session.model, session.joints))
        if (!body.fixed && body.answer.factor) guess = std::min(guess, *body.answer.factor);
    if (!std::isfinite(guess)) guess = session.model.clock.factor_of_safety;
    return guess >= least && guess <= most ? guess : 0;
}

Bracket narrowed(Trials& trials, Bracket bracket, double resolution) {
    constexpr double rounding = 1e-9;
    while (bracket.fails - bracket.stands > (1 + rounding) * resolution * bracket.stands) {
        trials.expect(1 + static_cast<int>(std::ceil(std::log2((bracket.fails / bracket.stands - 1) / resolution))));
        const double middle = 0.5 * (bracket.stands + bracket.fails);
        (trials.stands(middle) ? bracket.stands : bracket.fails) = middle;
    }
    return bracket;
}

bool closed(const Bracket& bracket) { return bracket.stands > 0 && std::isfinite(bracket.fails); }

/// A model that stands where a hasty trial failed: the search goes on upward.
Bracket bracket_above(Trials& trials, double stands, double resolution) {
    Bracket bracket{stands, stands};
    for (double width = widening * resolution; bracket.fails < largest; width *= 2) {
        bracket.stands = bracket.fails;
        bracket.fails *= 1 + width;
        if (!trials.stands(bracket.fails)) return narrowed(trials, bracket, resolution);
    }
    return {bracket.fails, INFINITY};
}

/// A bracket whose lower end may not stand: the search goes on downward, in steps that double, and gives up below `least`, with a lower end of 0.
Bracket bracket_below(Trials& trials, Bracket bracket, double resolution, double least) {
    if (trials.stands(bracket.stands)) return bracket;
    double width = resolution;
    for (bracket.fails = bracket.stands; bracket.stands > least; bracket.fails = bracket.stands) {
        bracket.stands /= 1 + width;
        width = std::min(1.0, 2 * width);
        if (trials.stands(bracket.stands)) return narrowed(trials, bracket, resolution);
    }
    return {0, bracket.fails};
}

/// The answer must not depend on haste, nor on the way to it. The factor with which the model fails is tried again, to the end, where that
/// trial had ended early; the one with which it stands is tried again from the beginning. Where either gives another answer the search goes on from there.
Bracket confirmed(Trials& trials, Bracket bracket, double resolution) {
    if (trials.failed_early()) {
        trials.be_patient();
        if (trials.stands(bracket.fails)) bracket = bracket_above(trials, bracket.fails, resolution);
    }
    if (!trials.has_warm_answer() || !closed(bracket)) return bracket;
    trials.begin_anew();
    const double least = trials.slides() ? turned_part * bracket.stands : 1 / largest;
    const Bracket below = bracket_below(trials, bracket, resolution, least);
    if (closed(below) || !trials.slides()) return below;
    trials.forget_sliding();
    return bracket_below(trials, bracket, resolution, 1 / largest);
}

} // namespace

void find_factor_of_safety(Session& session, const lang::Solve& command, const Limits& limits) {
    Bracket bracket;
    std::optional<FailureMode::Shares> mode;
    const double guess = command.bracket ? 0 : guessed_factor(session);
    if (guess > 0) session.output.say(fmt::format("the search begins at a factor of {:.4g}", guess));
    {
        Trials trials(session, command, limits);
        bracket = command.bracket ? given_bracket(trials, command)
                  : guess > 0     ? bracket_around(trials, guess)
                                  : found_bracket(trials);
        if (closed(bracket))
            bracket = confirmed(trials, narrowed(trials, bracket, command.resolution), command.resolution);
        if (!trials.mechanism().empty()) session.output.say(trials.mechanism());
        mode = trials.mode();
    }
    if (mode) session.output.say(mode_text(*mode));
    double& factor = session.model.clock.factor_of_safety;
    if (bracket.stands == 0) {
        factor = bracket.fails;
        session.output.say(fmt::format("factor of safety: below {:.6g}", bracket.fails));
    } else if (!std::isfinite(bracket.fails)) {
        factor = bracket.stands;
        session.output.say(fmt::format("factor of safety: above {:.6g}", bracket.stands));
    } else {
        factor = 0.5 * (bracket.stands + bracket.fails);
        session.output.say(
            fmt::format("factor of safety: {:.4g}, between {:.6g}, where it stands, and {:.6g}, where it fails", factor,
                        bracket.stands, bracket.fails));
    }
}

} // namespace kaya
