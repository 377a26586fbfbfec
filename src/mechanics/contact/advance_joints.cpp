#include "base/diagnostic.hpp"
#include "base/reduce.hpp"
#include "mechanics/contact/contact_kind.hpp"
#include "mechanics/contact/curved_closure.hpp"
#include "mechanics/contact/contact_stiffness.hpp"
#include "mechanics/shape/corner_joints.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/contact/overlap_contact.hpp"
#include "mechanics/contact/advance_joints.hpp"
#include "mechanics/contact/move_contact.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace kaya {

namespace {

constexpr std::size_t grain = 256; ///< contacts

/// Overlap without force below this part of a block's margin is ignored.
constexpr double negligible = 1e-3;
/// The part of the overlap without force that is recovered in each cycle.
constexpr double recovery = 5e-3;

/// Energy that has gone into a contact's springs.
struct Recovered {
    double of_friction = 0; ///< paid by the frictional work of the step
    double of_account = 0;  ///< paid by earlier changes of geometry
    double over_step = 0;   ///< force added times the displacement of the step

    /// Whether forces have been added.
    bool any() const { return of_friction + of_account > 0; }
};

/// A contact whose overlap exceeds what its force explains pushes the blocks apart, slowly enough to excite no vibration. The energy comes
/// from the account of earlier geometry changes, then from the frictional work of this step, `lost`: surfaces that climb on each other
/// while they slide take it from the force along them.
Recovered recover(Model& model, Row c, double lost) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    double& overlap = contacts.unforced_overlap[c];
    const auto& margin = model.blocks.margin;
    if (overlap < negligible * std::min(margin[contacts.block1[c]], margin[contacts.block2[c]])) {
        overlap = 0;
        return {};
    }
    const Span span = contacts.sub_contacts[c];
    const auto pushes = [&](Row s) { return subs.normal_force[s] > 0 || subs.normal_displacement[s] < 0; };
    double force = 0, stiffness = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        if (!pushes(s)) continue;
        force += subs.normal_force[s];
        stiffness += subs.normal_stiffness[s] * subs.area[s];
    }
    double& account = contacts.withdrawn_energy[c];
    double closed = recovery * overlap;
    const double wanted = (force + 0.5 * stiffness * closed) * closed, there = account + std::max(lost, 0.0);
    if (wanted > there)
        closed *= there / wanted; // the energy needed grows faster than the distance, so it stays within the budget
    const double needed = (force + 0.5 * stiffness * closed) * closed, of_account = std::min(needed, account);
    account -= of_account;
    overlap -= closed;
    double over_step = 0;
    for (Row s = span.first; s < span.end(); ++s) {
        if (!pushes(s)) continue;
        const double added = subs.normal_stiffness[s] * subs.area[s] * closed;
        over_step += added * subs.normal_displacement_increment[s];
        subs.normal_force[s] += added;
    }
    return {needed - of_account, of_account, over_step};
}

/// Sums over the sub-contacts of one contact; pore pressure acts on both sides in addition to the effective stress. `each` receives every
/// group of rows with the forces of the joint model.
template <class Each> void sum_contact(const Model& model, Row c, JointForces& forces, Each each) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Eight3 n = eights(contacts.normal[c]), origin = eights(contacts.position[c]);
    const Span span = contacts.sub_contacts[c];
    const bool deformable = model.blocks.deformable[contacts.block1[c]] || model.blocks.deformable[contacts.block2[c]];
    const bool damped = joints_are_damped(model.settings), overlap = follows_overlap(model, c);
    Eight3 force = eights(Vec3::Zero()), moment = force;
    for (Row i = 0; i < span.count; i += eight) {
        const RowsOfEight group(span.count - i);
        const Row first = span.first + i;
        Eight normal = group.load(subs.normal_force.data() + first);
        Eight3 shear = group.load(subs.shear_force, first);
        each(first, group, normal, shear);
        const Eight pressure = group.load(subs.pore_pressure.data() + first);
        Eight area = group.load(subs.area.data() + first);
        if (overlap && !all_zero(pressure))
            for (Row k = 0; k < group.rows(); ++k) area[k] = wet_area(model, c, first + k);
        normal += pressure * area;
        if (damped) {
            normal += group.load(subs.dashpot_normal.data() + first);
            shear = shear + group.load(subs.dashpot_shear, first);
        }
        const Eight3 f = n * normal + shear;
        if (deformable)
            for (Row k = 0; k < group.rows(); ++k) forces.of_sub_contact[first + k] = {f.x[k], f.y[k], f.z[k]};
        force = force + f;
        moment = moment + (group.load(subs.position, first) - origin).cross(f);
        if (overlap && i == 0) moment = moment + group.load(subs.shear_arm, first).cross(shear);
    }
    const Eight whole = sums_of({force.x, force.y, force.z, moment.x, moment.y, moment.z, Eight{}, Eight{}});
    forces.of_contact[c] = Vec3(whole[0], whole[1], whole[2]);
    forces.moment[c] = Vec3(whole[3], whole[4], whole[5]);
    if (contacts.twist[c] != 0) { // the pressure on a corner or an edge may exert a moment about the normal
        double normal = 0;
        for (Row s = span.first; s < span.end(); ++s) normal += subs.normal_force[s];
        forces.moment[c] += contacts.twist[c] * normal * contacts.normal[c];
    }
}

void sum_contact(const Model& model, Row c, JointForces& forces) {
    sum_contact(model, c, forces, [](Row, const RowsOfEight&, const Eight&, const Eight3&) {});
}

/// Computes the sums, the work of the joint model's forces, and the displacements at the end of the step.
void finish_contact(Model& model, Row c, JointForces& forces, JointWork& after) {
    auto& subs = model.sub_contacts;
    JointWork own; // stays in registers
    sum_contact(model, c, forces, [&](Row row, const RowsOfEight& group, const Eight& normal, const Eight3& shear) {
        const Eight opening = group.load(subs.normal_displacement_increment.data() + row);
        const Eight3 slip = group.load(subs.shear_displacement_increment, row);
        own.joint += normal * opening + shear.dot(slip);
        own.friction += group.load(subs.frictional_work.data() + row);
        add_increments(subs, row, group, opening, slip);
    });
    after.add(own);
}

/// Stiffness growth below this part per cycle waits for the next check of all bodies.
constexpr double slow_growth = 0.02;

/// Marks a contact whose stiffness has grown much, or whose places have moved relative to the centres of its blocks.
void note_stiffness(const Model& model, Row c, JointForces& forces) {
    const StiffnessOfSides now = follows_overlap(model, c) ? stiffness_over_mass(model, forces.compliance, c)
                                                           : StiffnessOfSides{sum_of_stiffness(model, c), 0};
    const StiffnessOfSides& before = forces.stiffness[c];
    const auto grows = [&](int side) { return now[side] > (1 + slow_growth) * before[side]; };
    // A contact that changes its kind acts on its blocks at other places.
    const ContactKind kind = model.contacts.kind[c];
    if (grows(0) || grows(1) || kind != forces.kind[c]) forces.stiffness_changed[c] = 1;
    forces.stiffness[c] = now;
    forces.kind[c] = kind;
}

/// Whether a joint between rigid blocks becomes an overlap contact.
bool opens_in_part(const Model& model, const JointModel& joint, Row c) {
    if (!model.settings.large_strain || !between_rigid(model, c)) return false;
    return is_partly_open(model, joint, c) &&
           !stands_on_corners(model, model.contacts.block1[c], model.contacts.block2[c]);
}

/// Geometry that was updated after the last motion has not slid.
bool has_new_geometry(const Model& model, Row c) { return model.contacts.slip_since_update[c] == 0; }

void take_contact(const Model& model, Row c, JointForces& forces) {
    sum_contact(model, c, forces);
    note_stiffness(model, c, forces);
    if (has_new_geometry(model, c) && model.contacts.kind[c] == ContactKind::joint) forces.stiffness_changed[c] = 1;
}

void combine(JointSums& sum, const JointSums& part) {
    sum.work += part.work;
    sum.friction += part.friction;
    sum.returned += part.returned;
    sum.lost += part.lost;
    sum.damped += part.damped;
    sum.stiffness_changed = sum.stiffness_changed || part.stiffness_changed;
}

bool is_pressed(const Model& model, Row c) {
    const Span span = model.contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s)
        if (model.sub_contacts.normal_force[s] > 0) return true;
    return false;
}

/// Computes the pair motions of the next eight contacts, if one of them needs them.
void take_pairs(Model& model, std::span<const Row> contacts, PairMotions& pairs) {
    const auto next = contacts.first(std::min<std::size_t>(eight, contacts.size()));
    if (std::ranges::any_of(next, [&](Row c) { return is_rigid_joint(model, c); })) pairs.take(model, next);
}

/// A force that changes after the step's work was summed acts during half of the step, by `over_step` over all of it. This is not part of the
/// energy stored in the springs.
void add_change(double over_step, JointWork& after, JointSums& sums) {
    after.joint[0] += over_step;
    sums.lost -= 0.5 * over_step;
}

/// A joint that is open in part continues as an overlap.
void follow_as_overlap(Model& model, const JointModel& joint, Row c, OverlapScratch& scratch, JointWork& after,
                       JointSums& sums) {
    const double work_before = work_of_step(model, c);
    sums.lost += follow_overlap(model, joint, c, scratch);
    add_change(work_of_step(model, c) - work_before, after, sums);
}

/// The joint model and the sums of a contact get the forces that its recovery has added.
void follow_recovery(Model& model, const JointModel& joint, Row c, const Recovered& energy, JointScratch& scratch,
                     JointForces& forces, JointWork& after, JointSums& sums) {
    add_change(energy.over_step, after, sums);
    initialise_rows(model, joint, c, model.contacts.sub_contacts[c].count, scratch.of_contact);
    sum_contact(model, c, forces);
}

/// `number` is that of the batch.
JointSums advance_batch(Model& model, const Batch& batch, std::int64_t number, JointForces& forces,
                        JointScratch& scratch) {
    JointSums sums;
    JointWork before;
    auto& friction = scratch.friction;
    auto& carried = scratch.carried;
    friction.resize(batch.contacts.size());
    carried.resize(batch.contacts.size());
    PairMotions pairs;
    for (std::size_t i = 0; i < batch.contacts.size(); ++i) {
        const Row c = batch.contacts[i];
        if (i % eight == 0) take_pairs(model, std::span(batch.contacts).subspan(i), pairs);
        if (follows_overlap(model, c)) {
            const OverlapStart start =
                move_overlap_contact(model, c, before, scratch.overlap, scratch.slopes_of(model, i, c));
            sums.lost += start.lost;
            turn_kept_vectors(model, c, batch.model->vectors);
            std::construct_at(&carried[i], model, c); // a copy would wait for what it has just written
            carried[i].lies = start.lies;
            if (model.contacts.curved[c] != 0) hold_shear(model, *batch.model, c, carried[i]);
        } else if (between_rigid(model, c)) {
            move_rigid_contact(model, c, pairs, i % eight, batch.model->vectors, before);
        } else {
            move_contact(model, c, batch.model->vectors, before);
        }
        if (model.contacts.unforced_overlap[c] > 0) friction[i] = frictional_work(model, c);
    }
    auto columns = columns_of(model, batch, model.clock.time_step, scratch.columns);
    std::optional<BatchDashpots> dashpots;
    if (joints_are_damped(model.settings)) dashpots.emplace(model, batch, scratch.row_friction);
    const Guard guard = guard_in_cycle(*batch.model, model.clock.cycle, number);
    if (const auto failure = run_batch(*batch.model, columns, model.sub_contacts.number.data() + batch.first, guard))
        throw joint_failure(model, batch, *failure);
    if (dashpots) sums.damped = dashpots->finish();
    JointWork after;
    double recovered = 0; // of what friction takes
    for (std::size_t i = 0; i < batch.contacts.size(); ++i) {
        const Row c = batch.contacts[i];
        if (follows_overlap(model, c)) {
            const bool closed_by_law = model.contacts.depth[c] == 0 && is_pressed(model, c);
            const OverlapEnd end = finish_overlap_contact(model, c, carried[i], scratch.slopes_of(model, i, c), after);
            sums.lost += end.lost;
            // A dilating joint model adds its dilation to the depth of an overlap, and may report a closed joint between separated blocks. It
            // begins again without force; otherwise each new contact would be as stiff as the accumulated dilation makes the joint, and the
            // blocks would keep bouncing.
            if (closed_by_law)
                initialise_rows(model, *batch.model, c, model.contacts.sub_contacts[c].count, scratch.of_contact);
            if (end.idle && !closed_by_law) forces.of_contact[c] = forces.moment[c] = Vec3::Zero();
            else sum_contact(model, c, forces);
            note_stiffness(model, c, forces);
            sums.stiffness_changed = sums.stiffness_changed || forces.stiffness_changed[c];
            continue;
        }
        finish_contact(model, c, forces, after);
        if (opens_in_part(model, *batch.model, c)) {
            follow_as_overlap(model, *batch.model, c, scratch.overlap, after, sums);
            sum_contact(model, c, forces);
            note_stiffness(model, c, forces);
            sums.stiffness_changed = true;
            continue;
        }
        if (model.contacts.unforced_overlap[c] > 0) {
            const Recovered energy = recover(model, c, frictional_work(model, c) - friction[i]);
            recovered += energy.of_friction;
            sums.returned += energy.of_account;
            if (energy.any()) follow_recovery(model, *batch.model, c, energy, scratch, forces, after, sums);
        }
        if (columns.stiffness_changed) note_stiffness(model, c, forces);
    }
    // A force or work that is NaN or infinite shows in the sums.
    if (!std::isfinite(sum(after.joint)) || !std::isfinite(sum(after.friction)))
        if (const auto failure = unusable_output(*batch.model, columns)) throw joint_failure(model, batch, *failure);
    sums.work = -0.5 * (sum(before.joint) + sum(after.joint));
    sums.friction = sum(after.friction) - sum(before.friction) - recovered;
    sums.damped -= 0.5 * (before.dashpots + after.dashpots);
    sums.stiffness_changed = sums.stiffness_changed || columns.stiffness_changed;
    return sums;
}

} // namespace

JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces,
                         PerThread<JointScratch>& scratch) {
    return reduce_chunks(
        batches.size(), 1, JointSums{},
        [&](std::size_t first, std::size_t) {
            return advance_batch(model, batches[first], static_cast<std::int64_t>(first), forces, scratch.local());
        },
        combine);
}

void joint_forces(const Model& model, JointForces& forces) {
    const bool any_deformable = model.zones.size() > 0;
    forces.of_sub_contact.assign(any_deformable ? model.sub_contacts.size() : 0, Vec3::Zero());
    forces.of_contact.assign(model.contacts.size(), Vec3::Zero());
    forces.moment.assign(model.contacts.size(), Vec3::Zero());
    forces.stiffness.assign(model.contacts.size(), StiffnessOfSides{});
    forces.compliance = compliances_of(model);
    forces.kind.assign(model.contacts.kind.begin(), model.contacts.kind.end());
    forces.stiffness_changed.assign(model.contacts.size(), 0);
    for_chunks(model.contacts.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c) take_contact(model, static_cast<Row>(c), forces);
    });
}

void joint_forces_of_new(const Model& model, JointForces& forces) {
    for_chunks(model.contacts.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t c = first; c < last; ++c)
            if (has_new_geometry(model, static_cast<Row>(c))) take_contact(model, static_cast<Row>(c), forces);
    });
}

} // namespace kaya
