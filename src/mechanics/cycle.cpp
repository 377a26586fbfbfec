#include "mechanics/cycle.hpp"

#include "base/diagnostic.hpp"
#include "base/memory.hpp"
#include "mechanics/contact_properties.hpp"
#include "mechanics/contact_search.hpp"
#include "mechanics/crushed_zones.hpp"
#include "mechanics/phases.hpp"
#include "mechanics/run_cables.hpp"
#include "mechanics/sub_contact_order.hpp"
#include "mechanics/take_over.hpp"
#include "mechanics/ties.hpp"
#include "mechanics/time_step.hpp"
#include "mechanics/zone_laws.hpp"
#include "model/measure.hpp"
#include "model/sampling.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace kaya {

namespace {

/// Power of adaptive global damping over the rate at which kinetic energy changes, of a ratio of 1: calibrated on
/// logs of 3DEC, docs/theory/damping.md.
constexpr double global_damping_scale = 4.6;
/// How much its viscosity changes in the largest stable step, from the same logs.
constexpr double viscosity_rate = 0.0033;
/// Cycles between two looks at all bodies while stiffnesses change little by little.
constexpr std::int64_t follow_interval = 10;

enum Phase { move, joint, zone, cable, search, gather, step, script, phase_count };

std::vector<PhaseTime> phase_names() {
    return {{"move bodies"},   {"contacts and joint models"}, {"zone models"}, {"cables"}, {"search contacts"},
            {"gather forces"}, {"time step limit"},           {"hooks and histories"}};
}

/// Joint properties that must be given and are not, and values that do not go together.
void check_properties(const Model& model, JointRegistry& joints) {
    std::set<Row> used;
    for (std::size_t c = 0; c < model.contacts.size(); ++c) {
        const Row row = model.contacts.properties[c];
        if (!used.insert(row).second) continue;
        const auto& set = model.joint_properties[row];
        const JointModel& joint = joints.get(set.model);
        std::string list;
        for (const auto& name : joint.missing(set.values)) list += (list.empty() ? "" : ", ") + name;
        const std::string complaint = list.empty() ? joint.check(set.values) : "";
        const auto mistake = [&]() -> std::optional<Diagnostic> {
            Diagnostic d(
                list.empty() ? fmt::format("joint model '{}': {}", joint.name, complaint)
                             : fmt::format("joint model '{}' is used without {}", joint.name, list),
                list.empty() ? "" : fmt::format("give it with `jmodel {} value` or `prop jmat {}`",
                                                joint.missing(set.values).front(), set.material));
            d.code = "property-missing";
            if (!list.empty() || !complaint.empty()) return d;
            try {
                joint.initial_stiffness(set.values);
            } catch (const Diagnostic& of_model) {
                return of_model;
            }
            return std::nullopt;
        }();
        if (!mistake) continue;
        Diagnostic d = *mistake;
        d.add(fmt::format("first used by contact {} between blocks {} and {}", model.contacts.number[c],
                          model.blocks.number[model.contacts.block1[c]],
                          model.blocks.number[model.contacts.block2[c]]));
        if (!set.place.empty()) d.add("properties given at " + set.place);
        throw d;
    }
}

Diagnostic motion_lost() {
    Diagnostic d("the motion of the model is no longer a number",
                 "a velocity or a force has grown without limit: look at the time step, stiffnesses and loads",
                 Fault::run);
    d.code = "motion-lost";
    return d;
}

} // namespace

/// What is derived from the model and never saved.
struct Cycle::Scratch {
    ContactSearch search;
    Adjacency adjacency;
    std::vector<Batch> batches;
    ZoneLaws laws;
    ZoneScratch zones;
    std::vector<ElasticConstants> elastic;
    HistoryLists boundary_histories;
    QuietPoints quiet;
    TieLists ties;
    TimeStep step;
    JointForces joints;
    std::vector<CableChain> cables;
    std::vector<PointRow> zone_forces;
    std::vector<PhaseTime> timing = phase_names();

    /// Calls a phase and adds its time.
    template <class Call> auto timed(Phase phase, Call call) {
        struct Stop {
            PhaseTime& time;
            std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
            ~Stop() {
                time.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                ++time.calls;
            }
        } stop{timing[phase]};
        return call();
    }
};

Cycle::Cycle(Model& model, JointRegistry& joints)
    : model_(model), joints_(joints), scratch_(std::make_unique<Scratch>()) {}

Cycle::~Cycle() = default;

const std::vector<PhaseTime>& Cycle::timing() const { return scratch_->timing; }

double Cycle::energy_in_zones() const {
    double sum = 0;
    for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
        if (!model_.blocks.deformable[b]) continue;
        const auto [lambda, two_shear] = scratch_->elastic[b];
        if (!(two_shear > 0)) continue;
        const Span zones = model_.blocks.zones[b];
        for (Row z = zones.first; z < zones.end(); ++z) {
            const Stress& s = model_.zones.stress[z];
            const double mean = (s[0] + s[1] + s[2]) / 3;
            const double deviator = (s.head<3>().array() - mean).square().sum() + 2 * s.tail<3>().squaredNorm();
            sum += zone_volume(model_, z) * (mean * mean / (2 * (lambda + two_shear / 3)) + deviator / (2 * two_shear));
        }
    }
    return sum;
}

void Cycle::prepare() {
    Scratch& s = *scratch_;
    if (model_.stale.contacts()) place_cable_nodes(model_);
    find_contacts(model_, joints_);
    if (model_.stale.properties()) {
        check_properties(model_, joints_);
        compute_masses(model_);
        take_zone_laws();
        s.ties = TieLists(model_, s.elastic);
        zone_frequencies(model_, s.elastic);
        add_tie_frequencies(model_, s.ties);
    }
    if (model_.stale.lists() || model_.stale.properties()) {
        take_cable_properties(model_);
        if (!model_.stale.properties()) take_zone_laws();
        s.step.forget(); // properties may be others now
        make_lists();
        if (!model_.stale.properties()) s.joints.stiffness_changed.assign(model_.contacts.size(), 0); // restored: all is known
        s.quiet = quiet_points(model_, s.elastic);
        s.search = ContactSearch{}; // blocks may be others now
        model_.stale.lists_made();
        model_.tables([](const char*, auto& table) {
            table.columns([](const std::string&, const auto& column, Role) {
                use_large_pages(column.data(), column.size() * sizeof(column[0]));
            });
        });
    }
    if (model_.stale.properties()) {
        apply_load_histories(model_, s.boundary_histories, hooks);
        if (s.adjacency.has_cables()) model_.energy.structure_work += run_cables(model_, s.cables);
        // Forces of what is there already, so that the first step starts from them.
        gather_forces(model_, s.adjacency, s.ties, s.joints, s.laws.tiles, s.zone_forces);
        model_.clock.time_step = 0;
        model_.clock.last_step = 0; // what a command has changed acts from now on
        s.step.limit(model_, s.adjacency, s.joints.stiffness_changed, TimeStep::Bodies::all_and_grow);
        model_.stale.properties_computed();
    }
}

void Cycle::take_zone_laws() {
    Scratch& s = *scratch_;
    s.laws = ZoneLaws(model_, joints_.zones);
    s.elastic = s.laws.elastic_constants();
    s.step.take(s.elastic);
}

void Cycle::make_lists() {
    Scratch& s = *scratch_;
    order_sub_contacts(model_);
    s.adjacency = make_adjacency(model_);
    s.batches = make_batches(model_, joints_);
    s.step.take(model_, s.batches);
    s.ties = TieLists(model_, s.elastic);
    s.boundary_histories = list_boundary_histories(model_);
    put_water(model_);
    joint_forces(model_, s.joints);
    zone_forces(model_, s.laws, s.zone_forces);
}

void Cycle::adapt_viscosity(const MotionSums& motion) {
    if (model_.settings.damping != Damping::global) return;
    double& viscosity = model_.clock.global_viscosity;
    const double change = std::abs(motion.kinetic - motion.kinetic_before);
    const double rate = viscosity_rate * time_step_fraction(model_.settings);
    viscosity *= motion.damped > global_damping_scale * model_.settings.global_ratio * change ? 1 - rate : 1 + rate;
    viscosity = std::min(viscosity, 1 / model_.clock.time_step);
}

void Cycle::keep_account(const HistorySums& prescribed, const MotionSums& motion, const JointSums& joint_sums,
                         const ZoneSums& zone_sums, double cable_work, double inner_power) {
    Energy& energy = model_.energy;
    // Velocities that were set from outside since the last step open the account anew by their energy.
    energy.start += motion.kinetic_before - prescribed.kinetic - energy.kinetic;
    energy.kinetic = motion.kinetic;
    // The half step up to such a change was gone with the velocities before it, and not with those that bodies saw.
    const double power_set = motion.inner_power - prescribed.inner_power - energy.inner_power;
    const double half_step = 0.5 * model_.clock.time_step;
    const bool opens = energy.lag == 0; // nothing is known of the half step before
    const double half_step_before = opens ? half_step : energy.lag;
    energy.inner_power = inner_power;
    energy.lag = half_step;
    if (!model_.settings.energy) return;
    constexpr double rounding_of_sums = 1e-12;
    if (std::abs(power_set) > rounding_of_sums * motion.inner_power_size)
        (opens ? energy.start : energy.boundary) += half_step_before * power_set;
    energy.gravity += prescribed.gravity + motion.gravity;
    energy.boundary += prescribed.boundary + motion.boundary + joint_sums.fluid;
    energy.damped += motion.damped + joint_sums.damped + zone_sums.damped;
    energy.joint_work += joint_sums.work;
    energy.joint_friction += joint_sums.friction;
    energy.joint_lost += joint_sums.lost - joint_sums.returned;
    energy.zone_work += zone_sums.work;
    energy.structure_work += cable_work;
    const Clock& clock = model_.clock;
    if (clock.last_step > 0) energy.step_made -= 0.25 * (clock.time_step - clock.last_step) * motion.inner_power_gain;
}

// The order of one step, and the only place where it stands.
void Cycle::advance() {
    prepare();
    tell_of_forces(model_, joints_);
    Scratch& s = *scratch_;
    Clock& clock = model_.clock;

    run_hooks(hooks.before_cycle);
    tell_of_forces(model_, joints_);
    // What begins to move does so overdamped, so that no joint slips in an overshoot before the viscosity has come down.
    if (model_.settings.damping == Damping::global && clock.global_viscosity == 0) clock.global_viscosity = 1 / clock.time_step;
    HistorySums prescribed;
    const MotionSums motion = s.timed(move, [&] {
        prescribed = apply_velocity_histories(model_, s.boundary_histories, hooks);
        if (!s.boundary_histories.velocities.empty()) prescribed.add(follow_prescribed(model_, s.ties));
        MotionSums sums = move_blocks(model_, s.adjacency.bodies);
        sums.add(move_gridpoints(model_, s.quiet, s.ties));
        return sums;
    });
    const JointSums joint_sums = s.timed(joint, [&] {
        put_water(model_);
        return advance_joints(model_, s.batches, s.joints);
    });
    const ZoneSums zone_sums = s.timed(zone, [&] {
        ZoneSums sums = run_zone_models(model_, s.laws, s.zones, s.zone_forces);
        sums.add(run_ties(model_, s.ties));
        return sums;
    });
    const double cable_work = s.adjacency.has_cables() ? s.timed(cable, [&] { return run_cables(model_, s.cables); }) : 0;
    const bool may_grow = step_may_grow(clock);
    clock.time += clock.time_step;
    ++clock.cycle;
    const ContactChange contacts_changed = s.timed(search, [&] {
        if (!model_.settings.large_strain) return ContactChange::none;
        ContactChange change = s.search.refresh_slipped(model_, joints_);
        if (ContactSearch::due(model_)) change = std::max(change, s.search.search(model_, joints_, true));
        if (change == ContactChange::none) return change;
        // A contact that is new may have a joint material of its own.
        if (change == ContactChange::replaced) check_properties(model_, joints_);
        if (model_.stale.lists()) make_lists();
        else joint_forces_of_new(model_, s.joints);
        model_.stale.lists_made();
        return change;
    });
    const double inner_power = s.timed(gather, [&] {
        apply_load_histories(model_, s.boundary_histories, hooks);
        return gather_forces(model_, s.adjacency, s.ties, s.joints, s.laws.tiles, s.zone_forces);
    });
    run_hooks(hooks.after_forces);

    if (!std::isfinite(motion.kinetic) || !std::isfinite(clock.unbalanced_force)) throw motion_lost();
    adapt_viscosity(motion);
    keep_account(prescribed, motion, joint_sums, zone_sums, cable_work, inner_power);
    s.step.audit(model_);
    clock.last_step = clock.time_step;
    const bool follows = joint_sums.stiffness_changed || s.step.forecasts();
    if (follows || contacts_changed != ContactChange::none || may_grow)
        s.timed(step, [&] {
            if (may_grow) {
                check_crushed_zones(model_);
                zone_frequencies(model_, s.elastic);
                add_tie_frequencies(model_, s.ties);
            }
            const auto bodies = may_grow                                        ? TimeStep::Bodies::all_and_grow
                              : follows && clock.cycle % follow_interval == 0 ? TimeStep::Bodies::all
                                                                              : TimeStep::Bodies::marked;
            s.step.limit(model_, s.adjacency, s.joints.stiffness_changed, bodies);
        });
    s.timed(script, [&] { sample_histories(model_, hooks.script_value); });
    run_hooks(hooks.after_cycle);
}

void Cycle::run_hooks(const std::vector<std::function<void()>>& list) {
    if (list.empty()) return;
    scratch_->timed(script, [&] {
        for (const auto& hook : list) hook();
    });
}

std::string Cycle::time_step_report() { return scratch_->step.report(model_, scratch_->adjacency); }

} // namespace kaya
