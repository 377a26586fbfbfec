#include "commands/stability/strength_trial.hpp"

#include "commands/monitors/failure_monitor.hpp"
#include "commands/run/run_cycles.hpp"
#include "commands/stability/slip.hpp"
#include "laws/property_roles.hpp"
#include "mechanics/common/crushed_zones.hpp"
#include "model/kinds/nearest.hpp"
#include "model/measure/measure.hpp"
#include "model/tables/model_edit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace kaya {

namespace {

/// A trial lowers the strength in this many steps over half a span, or comes nearly to rest after each.
constexpr int lowering_steps = 10;
constexpr double calm = 1e-3;
/// Spans of one trial: the first after which it may fail, the last where a block has moved by this part of its size, and the last where none
/// has: creep.
constexpr std::size_t first_end = 4, last_end = 12, last_of_creep = 36;
constexpr double far = 0.01;
/// Cycles after which a model that is brought to rest before its trials ought to be there.
constexpr std::int64_t most_to_rest = 100000;
/// Its unbalanced force falls where the later half of its spans has lost this part: near the limit a block sticks and slips, and the force
/// fluctuates.
constexpr double gain = 0.05;
/// A failed model slides on with its strength divided by this additional factor, to save time.
constexpr double shove = 1.1;
constexpr int spans_of_sliding = 3;

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

/// The model of the session while one trial runs.
class TrialRun {
public:
    TrialRun(const TrialBench& bench, const ReducedModel& start)
        : bench_(bench), model_(bench.session.engine.model), whole_(start.whole) {
        model_ = start.model;
        ModelEdit(model_, Change::lists);
    }

    /// Sets all strengths to the initial ones divided by the factor. Contacts that are new in a trial get the values of their material, which
    /// are whole.
    void lower(double factor) {
        auto& sets = model_.joint_properties;
        while (whole_.size() < sets.size()) whole_.push_back(sets[whole_.size()].values);
        if (bench_.asked.joints())
            for (std::size_t i = 0; i < sets.size(); ++i)
                if (const auto values =
                        reduced(bench_.session.engine.joints.get(sets[i].model), whole_[i], factor, bench_.asked))
                    sets[i].values = *values;
        model_.settings.strength_factor = bench_.asked.zones() ? factor : 1;
        ModelEdit(model_, Change::properties);
    }

    /// Neither at rest nor moving where a zone is crushed.
    RestSpan run(std::int64_t cycles, const RestRatio& ratio, FailureMonitor* monitor = nullptr) {
        try {
            return advance_span(bench_.session, cycles, ratio, monitor, &bench_.progress);
        } catch (const Diagnostic& failure) {
            if (failure.code != zone_crushed) throw;
            crushed_ = failure.message;
            bench_.session.autosave->begins(); // no cycle of the deck has failed
            return {};
        }
    }
    const std::string& crushed() const { return crushed_; }

    /// The state of a model that was left alone.
    struct Rest {
        RestSpan last;
        bool tired = false; ///< the unbalanced force does not get smaller
    };
    /// Cycles until the model is at rest or fails, but for so many spans at least.
    Rest settle(double factor, const RestRatio& ratio, std::size_t first, FailureMonitor* monitor) {
        Rest rest;
        std::vector<double> ratios; // means of spans
        const Model& initial = bench_.initial.model;
        const auto last = [&] { return any_has_moved_far(initial, model_) ? last_end : last_of_creep; };
        while (ratios.size() < first || (falls(ratios) && ratios.size() < last())) {
            if (model_.joint_properties.size() > whole_.size()) lower(factor);
            rest.last = run(bench_.span, ratio, monitor);
            if (rest.last.at_rest || rest.last.moving || rest.last.fails || !crushed_.empty()) return rest;
            ratios.push_back(rest.last.mean_ratio);
        }
        rest.tired = true;
        return rest;
    }

    /// At rest where it is, and with the shear that slipping joints have with their strength divided by the factor.
    void stop_sliding(const ReducedModel& sliding, double factor) {
        const Model& initial = bench_.initial.model;
        model_.gridpoints.velocity = initial.gridpoints.velocity;
        model_.blocks.velocity = initial.blocks.velocity;
        model_.blocks.rotational_velocity = initial.blocks.rotational_velocity;
        model_.blocks.angular_momentum = initial.blocks.angular_momentum;
        for (auto& column : model_.sub_contacts.shear_force.component)
            for (const Row row : *sliding.slipping) column[row] *= sliding.factor / factor;
    }

    FailureMode mode() const { return {model_, *bench_.session.engine.cycle}; }
    FailureMode::Shares shares(const FailureMode& since) const {
        return since.shares(model_, *bench_.session.engine.cycle);
    }
    const Model& model() const { return model_; }
    std::int64_t cycles(const ReducedModel& since) const { return model_.clock.cycle - since.model.clock.cycle; }
    ReducedModel end(double factor) const { return {model_, whole_, factor}; }

private:
    const TrialBench& bench_;
    Model& model_;
    std::vector<std::vector<double>> whole_;
    std::string crushed_; ///< a zone
};

/// Forces and stresses.
using Answer = std::tuple<Column<double>, std::array<Column<double>, 3>, Column<Stress>>;

/// Those one cycle after a state of motion, when joints and zones remember it or not.
Answer answer_of_next_cycle(const TrialBench& bench, const ReducedModel& sliding, bool forgets) {
    TrialRun run(bench, sliding);
    Model& model = bench.session.engine.model;
    if (forgets) forget_slip(model, bench.initial.model, bench.session.engine.joints);
    ModelEdit(model, Change::properties);
    run.run(1, {0});
    return {model.sub_contacts.normal_force, model.sub_contacts.shear_force.component, model.zones.stress};
}

} // namespace

Trial run_trial(const TrialBench& bench, const ReducedModel& start, double factor, const TrialRule& rule) {
    TrialRun run(bench, start);
    Trial trial;
    TrialRun::Rest rest;
    std::optional<FailureMode> mode;
    // A bolt across a slipping joint is far softer than a span accounts for: how long a block keeps moving is unknown.
    const bool to_its_end = start.model.structures.stand() && !rule.ends_with_bolts;
    const std::size_t first_spans = to_its_end ? last_end : first_end;
    // A model that is unstable at present must not begin to slide on the way to more strength.
    const double first = start.factor < factor ? start.factor : 0.5 * factor;
    if (start.slipping) run.stop_sliding(start, factor);
    // Step by step: a sudden reduction could push joints past their peak, irreversibly.
    else
        for (int step = 1; step < lowering_steps && !rest.tired && run.crushed().empty(); ++step) {
            const double part = rule.settles_between ? 1 - std::pow(0.5, step)
                                                     : static_cast<double>(step) / lowering_steps,
                         lowered = first * std::pow(factor / first, part);
            run.lower(lowered);
            if (rule.settles_between) {
                mode.emplace(run.mode()); // it may fail on the way
                rest = run.settle(lowered, {calm}, first_spans, nullptr);
            } else run.run(std::max<std::int64_t>(1, bench.span / (2 * lowering_steps)), {0});
        }
    if (!rest.tired && run.crushed().empty()) {
        run.lower(factor);
        bench.session.engine.cycle->prepare();
        mode.emplace(run.mode());
        FailureMonitor monitor(run.model(), *bench.session.engine.cycle,
                               static_cast<std::int64_t>(rule.window * static_cast<double>(bench.span)));
        rest = run.settle(factor, bench.ratio, first_spans, to_its_end ? nullptr : &monitor);
    }
    trial.began = start.factor, trial.cycles = run.cycles(start), trial.crushed = run.crushed();
    trial.stands = rest.last.at_rest, trial.goes_on = rest.last.fails, trial.moving = rest.last.moving;
    if (trial.stands) run.lower(factor); // what is new
    else if (mode) trial.mode = run.shares(*mode);
    trial.end = run.end(factor);
    return trial;
}

bool slip_counts(const TrialBench& bench) {
    const Model& model = bench.initial.model;
    return std::ranges::any_of(property_sets_in_use(model), [&](Row row) {
        const auto& set = model.joint_properties[row];
        const JointModel& joint = bench.session.engine.joints.get(set.model);
        return find_role(joint, KAYA_JROLE_STRENGTH_FACTOR) || loses_strength(joint, set.values);
    });
}

std::optional<ReducedModel> brought_to_rest(const TrialBench& bench) {
    TrialRun run(bench, bench.initial);
    const double whole = bench.initial.factor;
    for (bool at_rest = false; !at_rest; at_rest = run.run(bench.span, bench.ratio).at_rest) {
        if (run.cycles(bench.initial) > most_to_rest || !run.crushed().empty()) return std::nullopt;
        if (any_has_moved_far(bench.initial.model, run.model())) return std::nullopt;
    }
    run.lower(whole); // what is new
    return run.end(whole);
}

std::optional<ReducedModel> slide_on(const TrialBench& bench, const ReducedModel& failed) {
    if (bench.initial.model.structures.stand()) return std::nullopt; // bolts take up load during motion
    const double factor = shove * failed.factor;
    TrialRun run(bench, failed);
    run.lower(factor);
    bench.session.engine.cycle->prepare();
    const FailureMode mode = run.mode();
    Slip slip(run.model());
    for (int i = 0; i < spans_of_sliding && !slip.has_turned_shear(run.model()) && run.crushed().empty(); ++i) {
        if (!slip.follows(run.model())) slip = Slip(run.model());
        run.run(bench.span, {0});
    }
    if (!run.crushed().empty() || !slip.has_turned_shear(run.model()) || run.shares(mode).topples())
        return std::nullopt;
    ReducedModel sliding = run.end(factor);
    sliding.slipping = slip.rows(run.model());
    if (answer_of_next_cycle(bench, sliding, false) != answer_of_next_cycle(bench, sliding, true)) return std::nullopt;
    return sliding;
}

} // namespace kaya
