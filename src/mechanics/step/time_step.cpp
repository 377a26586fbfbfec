#include "mechanics/step/time_step.hpp"

#include "base/number_text.hpp"
#include "mechanics/common/remedy.hpp"
#include "mechanics/step/density_scaling.hpp"
#include "mechanics/structures/member_lists.hpp"
#include "model/measure/compatibility.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace kaya {

namespace {

/// The step shrinks a little more than it must, so that it does not have to again in the next cycle.
constexpr double shrink = 0.9;
/// Masses that were scaled for a step give it back but for rounding.
constexpr double rounding = 1e-8;
/// The part of the energy that has been turned over which a step beyond the bound may have made.
constexpr double most_made = 0.1;
/// Full density scaling makes no body lighter than this part of its mass: its weight would accelerate a lightly supported body too strongly.
constexpr double lightest = 0.1;

/// Where nothing is elastic, a thousandth of the time to fall through one's own size is fine enough.
double step_of_falling(const Model& model) {
    double size = 1;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) size = std::min(size, std::cbrt(model.blocks.volume[b]));
    const double g = model.settings.gravity.norm();
    return 1e-3 * (g > 0 ? std::sqrt(2 * size / g) : 1.0);
}

/// Equation (11) of docs/theory/time-step.md; infinite when no rigid block that moves has a contact.
double step_of_3dec(const Model& model) {
    const auto& blocks = model.blocks;
    std::vector<double> stiffest(blocks.size(), 0), surface(blocks.size(), 0);
    const auto& subs = model.sub_contacts;
    for (std::size_t s = 0; s < subs.size(); ++s)
        for (const Row block : {model.contacts.block1[subs.contact[s]], model.contacts.block2[subs.contact[s]]})
            stiffest[block] = std::max(stiffest[block], subs.normal_stiffness[s]);
    for (Row f = 0; f < static_cast<Row>(model.faces.size()); ++f)
        surface[model.faces.block[f]] += face_area_vector(model, f).norm();
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks.deformable[b] || blocks.fixed[b] == fix_all || !(stiffest[b] > 0)) continue;
        step = std::min(step, std::sqrt(blocks.mass[b] / (2 * stiffest[b] * surface[b])));
    }
    return step;
}

/// Limit by the nodes of beams and liners: none where their masses follow the step, unless no other body limits it.
MemberLimit limit_of_members(const Model& model, double of_rock) {
    const bool none = model.structures.members.empty();
    return none || (member_masses_follow(model.settings) && !std::isinf(of_rock)) ? MemberLimit{} : member_limit(model);
}

} // namespace

/// Density scaling. `anew`: masses may also decrease and the step may change; otherwise the step is kept, and bodies that are too stiff for
/// it get more mass. Returns the largest stable step.
double TimeStep::fit_masses(Model& model, const Adjacency& adjacency, bool anew) {
    const Settings& settings = model.settings;
    const double fraction = time_step_fraction(settings);
    // Dashpots of contacts follow the masses and shorten the step in turn.
    const auto stable = [&](Masses masses = Masses::inertial) {
        return bounds_.limit(model, adjacency, masses).stable;
    };
    if (settings.mass_scaling == MassScaling::full) {
        const double given = settings.given_time_step;
        if (!anew) {
            const double kept = model.clock.time_step / fraction;
            const BodyStiffness& stiffness = bounds_.stiffness(model, adjacency, std::max(kept, given / fraction));
            const bool raised = raise_masses(model, stiffness, kept);
            return raised && joints_are_damped(settings) ? stable() : least_stable_step(model, stiffness);
        }
        const BodyStiffness& stiffness = bounds_.stiffness(model, adjacency);
        const double target = given > 0 ? given / fraction : mean_stable_step(model, stiffness);
        if (target > 0) scale_masses(model, stiffness, target, lightest);
        return stable();
    }
    const double wanted = settings.scaled_time_step;
    if (anew && fraction * stable(Masses::real) >= wanted) {
        restore_masses(model);
        return stable();
    }
    const double target = wanted / fraction;
    if (anew) scale_masses(model, bounds_.stiffness(model, adjacency), target, 1);
    double reached = stable();
    for (int i = 0; i < 20 && fraction * reached < wanted; ++i) {
        raise_masses(model, bounds_.stiffness(model, adjacency), target);
        reached = stable();
    }
    return reached;
}

/// `all`: `stable` is the bound of all bodies, and of nodes of members.
void TimeStep::take_given(Model& model, const Adjacency& adjacency, double stable, double of_members, bool all) {
    const double given = model.settings.given_time_step;
    if (given <= stable) {
        model.clock.time_step = given;
        if (all) beyond_bound_ = false;
        return;
    }
    // The bound is conservative; the coupled motion of the bodies may allow more.
    const double needed = std::max(0.25 * given * given * bounds_.estimate(model, adjacency, given),
                                   (given / of_members) * (given / of_members));
    if (needed > 1) {
        Diagnostic d(fmt::format("the time step {:.6g} is above the largest stable one, {:.6g}", given,
                                 std::max(stable, given / std::sqrt(needed))),
                     "give a smaller one, or none");
        d.add(report(model, adjacency));
        throw d;
    }
    model.clock.time_step = given;
    beyond_bound_ = true;
    model.settings.energy = true;
}

void TimeStep::audit(const Model& model) const {
    if (!beyond_bound_) return;
    const Energy& e = model.energy;
    const double made = -e.error();
    const double turned =
        e.start + std::abs(e.gravity) + std::abs(e.boundary) + e.kinetic + std::abs(e.damped) + e.joint_friction;
    if (!(made > most_made * turned)) return;
    Advised d(fmt::format("the time step {:.6g} makes energy: {:.6g} of {:.6g} come from nowhere",
                          model.clock.time_step, made, turned),
              Advice::give_shorter_step, {}, Fault::run);
    d.code = "step-makes-energy";
    throw d;
}

/// The longest step, not above `step`, that is still short enough for the stiffness of the joints at its end.
double TimeStep::without_growth(const Model& model, const Adjacency& adjacency, double step, StiffnessForecast::Of of) {
    const double fraction = time_step_fraction(model.settings);
    for (int i = 0; i < 200 && ahead_.update(model, adjacency, step, of); ++i) {
        bounds_.foreseen = &ahead_.springs();
        bounds_.update_at(model, adjacency, ahead_.marks(), StepBounds::Of::bodies_and_neighbours);
        const double allowed = fraction * bounds_.limit(model, adjacency, Masses::inertial, step / fraction).stable;
        bounds_.foreseen = nullptr;
        if (allowed >= (1 - rounding) * step) break;
        step = std::max(allowed, 0.5 * step);
    }
    return step;
}

void TimeStep::limit(Model& model, const Adjacency& adjacency, std::vector<char>& changed, Bodies bodies) {
    limit_bodies(model, adjacency, changed, bodies);
    fit_member_masses(model);
}

void TimeStep::limit_bodies(Model& model, const Adjacency& adjacency, std::vector<char>& changed, Bodies bodies) {
    Clock& clock = model.clock;
    const Settings& settings = model.settings;
    const bool scaled = settings.mass_scaling != MassScaling::none, may_grow = bodies == Bodies::all_and_grow;
    // Dashpots follow the masses, and bounds of neighbours follow dashpots.
    const bool all = bodies != Bodies::marked || clock.time_step == 0 || (scaled && joints_are_damped(settings));
    double stable = std::numeric_limits<double>::infinity();
    if (all || std::find(changed.begin(), changed.end(), 1) != changed.end()) {
        // Masses that only rise follow each body's own bound.
        const bool rise = settings.mass_scaling == MassScaling::full && !may_grow && clock.time_step > 0 &&
                          !joints_are_damped(settings);
        if (all)
            bounds_.update(model, adjacency, rise ? StepBounds::Of::bodies : StepBounds::Of::bodies_and_neighbours);
        else
            bounds_.update_at(model, adjacency, changed,
                              scaled ? StepBounds::Of::bodies : StepBounds::Of::bodies_and_neighbours);
        std::fill(changed.begin(), changed.end(), 0);
        if (scaled) {
            // The step is kept and masses follow, also for the stiffness at the end of the step.
            if (ahead_.needed() && clock.time_step > 0 && ahead_.update(model, adjacency, clock.time_step)) {
                bounds_.foreseen = &ahead_.springs();
                bounds_.update(model, adjacency);
            }
            stable = fit_masses(model, adjacency, may_grow || clock.time_step == 0);
        } else {
            // A step that may not grow needs no exact bound where it is short enough.
            const double enough =
                may_grow || clock.time_step == 0
                    ? std::numeric_limits<double>::infinity()
                    : std::max(clock.time_step, settings.given_time_step) / time_step_fraction(settings);
            stable = bounds_.limit(model, adjacency, Masses::inertial, enough).stable;
        }
        bounds_.foreseen = nullptr;
    }
    const double of_members = all ? limit_of_members(model, stable).stable : std::numeric_limits<double>::infinity();
    stable = std::min(stable, of_members);
    if (settings.given_time_step > 0) return take_given(model, adjacency, stable, of_members, all);
    const double before = clock.time_step;
    const bool asks_3dec = as_3dec(settings) && !scaled && all;
    const double wanted = std::min(time_step_fraction(settings) * stable,
                                   asks_3dec ? step_of_3dec(model) : std::numeric_limits<double>::infinity());
    if (before == 0) clock.time_step = std::isinf(wanted) ? step_of_falling(model) : wanted;
    double step = clock.time_step;
    if (!std::isinf(wanted)) {
        const double least = settings.mass_scaling == MassScaling::partial ? settings.scaled_time_step : 0;
        if (wanted < (1 - rounding) * step) step = std::max(shrink * wanted, std::min(wanted, least));
        else if (may_grow && wanted * shrink * shrink > step) step = wanted;
    }
    // Overlaps look ahead by the steps that they have made: a first or a longer step must look for itself.
    const auto of = step > before ? StiffnessForecast::Of::laws_and_overlaps : StiffnessForecast::Of::laws;
    const bool may_stiffen = ahead_.needed() || step > before;
    clock.time_step = may_stiffen && !scaled ? without_growth(model, adjacency, step, of) : step;
}

std::string TimeStep::report(const Model& model, const Adjacency& adjacency) {
    bounds_.update(model, adjacency);
    const StepLimit limit = bounds_.limit(model, adjacency);
    if (const MemberLimit members = limit_of_members(model, limit.stable); members.stable < limit.stable) {
        const auto& nodes = model.structures.member_nodes;
        const Row member = nodes.member[members.node];
        return fmt::format("largest stable step {:.6g}, set by node {} of {} {}", members.stable,
                           members.node - model.structures.members.nodes[member].first + 1,
                           model.structures.members.kind[member] == beam_kind ? "beam" : "liner",
                           model.structures.members.number[member]);
    }
    if (!limit.exists()) return "nothing limits the time step: no stiffness acts";
    if (limit.of_block)
        return fmt::format("largest stable step {:.6g}, set by block {} and the joints on it", limit.stable,
                           model.blocks.number[limit.row]);
    const auto& points = model.gridpoints;
    const Vec3& x = points.position[limit.row];
    return fmt::format("largest stable step {:.6g}, set by the gridpoint of block {} at {}: "
                       "{:.0f} % by its zones, {:.0f} % by joints",
                       limit.stable, model.blocks.number[points.block[limit.row]], place_text(x),
                       100 * limit.part_of_zones, 100 * (1 - limit.part_of_zones));
}

} // namespace kaya
