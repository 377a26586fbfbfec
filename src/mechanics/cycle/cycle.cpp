#include "mechanics/cycle/cycle.hpp"

#include "base/diagnostic.hpp"
#include "base/parallel.hpp"
#include "mechanics/bodies/adjacency.hpp"
#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/contact/advance_joints.hpp"
#include "mechanics/supports/apply_histories.hpp"
#include "mechanics/contact/batches.hpp"
#include "mechanics/zones/cell_state.hpp"
#include "mechanics/assign/check_properties.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/contact/contact_search.hpp"
#include "mechanics/contact/contact_work.hpp"
#include "mechanics/common/crushed_zones.hpp"
#include "mechanics/motion/damping_policy.hpp"
#include "mechanics/step/energy.hpp"
#include "mechanics/cycle/gather_forces.hpp"
#include "mechanics/cycle/grid_pass.hpp"
#include "mechanics/common/growth.hpp"
#include "mechanics/common/masses.hpp"
#include "mechanics/motion/move_bodies.hpp"
#include "mechanics/supports/quiet_boundary.hpp"
#include "mechanics/zones/ruled_faces.hpp"
#include "mechanics/zones/shared_faces.hpp"
#include "mechanics/bodies/run_cables.hpp"
#include "mechanics/motion/run_members.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/common/sub_contact_order.hpp"
#include "mechanics/contact/take_over.hpp"
#include "mechanics/ties/ties.hpp"
#include "mechanics/step/time_step.hpp"
#include "mechanics/supports/water.hpp"
#include "mechanics/zones/zone_frequencies.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/edit/bounded.hpp"
#include "model/fields/sampling.hpp"
#include "model/structures/structures.hpp"
#include "system/memory.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// Cycles between two checks of all bodies while stiffnesses change slowly.
constexpr std::int64_t follow_interval = 10;

/// Whether nothing has a velocity: then no step has led to the present one.
bool at_rest(const Model& model) {
    const auto none = [](const auto& column) {
        return std::ranges::all_of(column, [](const Vec3& v) { return v.isZero(0); });
    };
    const auto& nodes = model.structures.member_nodes;
    return none(model.blocks.velocity) && none(model.blocks.rotational_velocity) && none(model.gridpoints.velocity) &&
           none(nodes.velocity) && none(nodes.spin);
}

} // namespace

/// Derived data, never saved.
struct Cycle::Lists {
    ContactSearch search;
    Adjacency adjacency;
    std::vector<Batch> batches;
    ZoneLaws laws;
    ZoneScratch zones;
    std::vector<ElasticConstants> elastic;
    HistoryLists boundary_histories;
    QuietPoints quiet;
    TieLists ties;
    TieScratch tie_scratch;
    TimeStep step;
    JointForces joints;
    PerThread<JointScratch> joint_scratch;
    std::vector<CableChain> cables;
    MemberLists members;
    std::vector<PointRow> zone_forces;
    PointForces point_forces{adjacency, ties, joints, laws.tiles, zone_forces};
    GridPass pass;
    std::vector<Bytes> columns; ///< that have been put on large pages
    bool passed = false;        ///< zones have been advanced together with their gridpoints
};

Cycle::Cycle(Model& model, JointRegistry& joints) : model_(model), joints_(joints), lists_(std::make_unique<Lists>()) {}

Cycle::~Cycle() = default;

double Cycle::energy_in_zones() const {
    bring_up_to_date();
    return kaya::energy_in_zones(model_, lists_->elastic);
}

void Cycle::bring_up_to_date() const { lists_->zones.cells.give_back(model_, lists_->laws.tiles); }

void Cycle::prepare() {
    Lists& s = *lists_;
    if (model_.stale.any()) bring_up_to_date();
    find_contacts(model_, joints_);
    const bool changed = model_.stale.properties(); // else restored: all is known
    if (changed) {
        check_properties(model_, joints_);
        compute_masses(model_);
        take_zone_laws();
        share_masses(model_, s.laws);
        settle_cells(model_, s.laws);
        zone_frequencies(model_, s.laws);
        add_tie_frequencies(model_, s.ties);
    }
    if (changed || model_.stale.lists()) {
        take_structure_properties(model_);
        if (changed) compute_member_masses(model_);
        s.members = MemberLists(model_);
        if (!changed) take_zone_laws();
        s.step.forget(); // properties may have changed
        if (changed) find_ends_of_water(model_);
        make_lists(changed ? Since::changed : Since::restored);
        if (!changed) s.joints.stiffness_changed.assign(model_.contacts.size(), 0);
        s.quiet = quiet_points(model_, s.elastic);
        s.search = ContactSearch{}; // blocks may have changed
        model_.stale.lists_made();
        use_large_pages();
    }
    if (changed) {
        apply_load_histories(model_, s.boundary_histories, hooks);
        if (model_.structures.stand()) model_.energy.structure_work += run_structures(0);
        // Computes the present forces, from which the first step starts.
        gather_forces(model_, s.point_forces, s.members);
        model_.clock.time_step = 0;
        s.step.limit(model_, s.adjacency, s.joints.stiffness_changed, TimeStep::Bodies::all_and_grow);
        // The present forces also act in the last half step, which counts as no longer than the next one: they may be new.
        model_.clock.last_step = at_rest(model_) ? 0 : std::min(model_.clock.last_step, model_.clock.time_step);
        model_.stale.properties_computed();
    }
}

/// Tables that grow move to other memory.
void Cycle::use_large_pages() {
    std::vector<Bytes> columns;
    model_.tables([&](const char*, auto& table) {
        table.columns([&](std::string_view, const auto& column, Role) {
            columns.push_back({column.data(), column.capacity() * sizeof(column[0])});
        });
    });
    if (columns == lists_->columns) return;
    kaya::use_large_pages(columns);
    lists_->columns = std::move(columns);
}

void Cycle::take_zone_laws() {
    Lists& s = *lists_;
    s.laws = ZoneLaws(model_, joints_.zones);
    s.elastic = s.laws.elastic_constants();
    s.ties = TieLists(model_, s.elastic);
    find_ruled_faces(model_, s.ties, s.laws);
    find_shared_faces(model_, s.laws);
    s.step.take(s.elastic);
}

void Cycle::make_lists(Since since) {
    Lists& s = *lists_;
    bring_up_to_date();
    order_sub_contacts(model_);
    s.adjacency = make_adjacency(model_);
    s.batches = make_batches(model_, joints_);
    s.step.take(model_, s.batches);
    if (since == Since::changed) {
        note_curved(model_, s.batches);
        put_water(model_);
    }
    s.boundary_histories = list_boundary_histories(model_);
    joint_forces(model_, s.joints);
    zone_forces(model_, s.laws, s.zone_forces);
    s.pass = {};
}

// The order of one step, defined here only.
void Cycle::advance() {
    StepSums sums;
    lists_->zones.cells.wanted = unwatched_ > 0;
    begin();
    const double kick = model_.clock.kick();
    move(sums);
    if (!std::isfinite(sums.motion.kinetic)) throw diverged(model_); // before a joint model is blamed for it
    strain(sums);
    const bool may_grow = step_may_grow(model_.clock);
    model_.clock.time += model_.clock.time_step;
    ++model_.clock.cycle;
    const ContactChange change = refresh_contacts();
    if (counts_water()) sums.fluid += 0.5 * fluid_work(model_, StepPlaces::end);
    gather(sums);
    close_account(sums);
    limit_step(sums, change, may_grow);
    record(kick);
}

void Cycle::begin() {
    prepare();
    tell_of_forces(model_, joints_);
    run_hooks(hooks.before_cycle);
    tell_of_forces(model_, joints_);
    start_viscosity(model_);
}

/// Velocities and positions; zones as well where they depend on nothing else.
void Cycle::move(StepSums& sums) {
    Lists& s = *lists_;
    s.passed = GridPass::possible(model_, s.laws, s.ties);
    times_.timed(Phase::move, [&] {
        sums.prescribed = apply_velocity_histories(model_, s.boundary_histories, hooks);
        if (!s.boundary_histories.velocities.empty()) sums.prescribed.add(follow_prescribed(model_, s.ties));
        sums.motion = move_blocks(model_, s.adjacency.bodies);
        if (!s.passed) sums.motion.add(move_gridpoints(model_, s.quiet, s.ties));
    });
    s.pass.forget_gathered();
    if (s.passed)
        times_.timed(Phase::zones, [&] {
            if (s.pass.threads() != threads()) s.pass = GridPass(model_, s.laws.tiles, threads());
            const bool loads_stay = s.boundary_histories.loads.empty();
            s.pass.run(model_, s.quiet, s.laws, s.zones, s.point_forces, loads_stay, s.zone_forces);
            sums.motion.add(s.pass.motion());
            sums.zones = s.pass.zones();
        });
    if (s.members.any()) times_.timed(Phase::structures, [&] { sums.motion.add(move_members(model_, s.members)); });
}

double Cycle::run_structures(double step) {
    Lists& s = *lists_;
    return run_cables(model_, s.cables, step) + run_members(model_, s.members, step);
}

/// The account needs the work of the pressure that has acted, and of the one that acts next: contacts come, go and change their areas between.
bool Cycle::counts_water() const { return model_.settings.energy && model_.settings.water != Water::none; }

/// The responses: joints, zones, ties, structures.
void Cycle::strain(StepSums& sums) {
    Lists& s = *lists_;
    times_.timed(Phase::joints, [&] {
        if (counts_water()) sums.fluid += 0.5 * fluid_work(model_, StepPlaces::start);
        put_water(model_);
        sums.joints = advance_joints(model_, s.batches, s.joints, s.joint_scratch);
    });
    times_.timed(Phase::zones, [&] {
        if (!s.passed) sums.zones = run_zone_models(model_, s.laws, s.zones, s.zone_forces);
        sums.zones.add(run_ties(model_, s.ties, s.tie_scratch));
    });
    if (model_.structures.stand())
        times_.timed(Phase::structures, [&] { sums.structure_work = run_structures(model_.clock.time_step); });
}

ContactChange Cycle::refresh_contacts() {
    Lists& s = *lists_;
    return times_.timed(Phase::search, [&] {
        ContactChange change = s.search.refresh_slipped(model_, joints_);
        const bool far = model_.settings.large_strain && ContactSearch::due(model_);
        if (far) change = std::max(change, s.search.search(model_, joints_, true));
        // Blocks that move together keep their contacts, but not their depth in water.
        if (far || change != ContactChange::none) find_ends_of_water(model_);
        if (change == ContactChange::none) return change;
        // A new contact may have its own joint material.
        if (change == ContactChange::replaced) check_properties(model_, joints_);
        if (model_.stale.lists()) {
            make_lists(Since::changed);
            use_large_pages();
        } else {
            joint_forces_of_new(model_, s.joints);
        }
        s.pass.forget_gathered();
        model_.stale.lists_made();
        return change;
    });
}

void Cycle::gather(StepSums& sums) {
    Lists& s = *lists_;
    times_.timed(Phase::gather, [&] {
        apply_load_histories(model_, s.boundary_histories, hooks);
        sums.inner_power = gather_forces(model_, s.point_forces, s.members, s.pass.gathered());
    });
    run_hooks(hooks.after_forces);
}

void Cycle::close_account(const StepSums& sums) {
    if (!std::isfinite(model_.clock.unbalanced_force)) throw diverged(model_);
    adapt_viscosity(model_, sums.motion);
    keep_account(model_, sums);
    lists_->step.audit(model_);
    model_.clock.last_step = model_.clock.time_step;
}

void Cycle::limit_step(const StepSums& sums, ContactChange change, bool may_grow) {
    Lists& s = *lists_;
    const bool follows = sums.joints.stiffness_changed || s.step.forecasts();
    if (!follows && change == ContactChange::none && !may_grow) return;
    times_.timed(Phase::step, [&] {
        if (may_grow) {
            check_crushed_zones(model_);
            zone_frequencies(model_, s.laws);
            add_tie_frequencies(model_, s.ties);
        }
        const auto bodies = may_grow                                               ? TimeStep::Bodies::all_and_grow
                            : follows && model_.clock.cycle % follow_interval == 0 ? TimeStep::Bodies::all
                                                                                   : TimeStep::Bodies::marked;
        s.step.limit(model_, s.adjacency, s.joints.stiffness_changed, bodies);
    });
}

void Cycle::record(double kick) {
    times_.timed(Phase::scripts, [&] {
        if (samples_zones(model_)) bring_up_to_date();
        sample_histories(model_, kick, hooks.script_value);
    });
    run_hooks(hooks.after_cycle);
}

void Cycle::run_hooks(const std::vector<std::function<void()>>& list) {
    if (list.empty()) return;
    times_.timed(Phase::scripts, [&] {
        for (const auto& hook : list) hook();
    });
}

std::string Cycle::time_step_report() { return lists_->step.report(model_, lists_->adjacency); }

} // namespace kaya
