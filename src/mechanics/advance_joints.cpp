#include "base/diagnostic.hpp"
#include "base/reduce.hpp"
#include "mechanics/dashpots.hpp"
#include "model/lanes.hpp"
#include "mechanics/phases.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace kaya {

namespace {

constexpr std::size_t grain = 256; ///< contacts

/// In parts of a block's margin: an overlap beyond what the force says that is not worth looking at.
constexpr double negligible = 1e-3;
/// The part of it that comes back in each cycle.
constexpr double recovery = 5e-3;

/// A contact that overlaps more than its force says pushes the blocks apart so slowly that it shakes nothing.
void recover(Model& model, Row c) {
    auto& contacts = model.contacts;
    auto& subs = model.sub_contacts;
    double& sunk = contacts.sunk[c];
    if (sunk <= 0) return;
    const auto& margin = model.blocks.margin;
    if (sunk < negligible * std::min(margin[contacts.block1[c]], margin[contacts.block2[c]])) {
        sunk = 0;
        return;
    }
    const double closed = recovery * sunk;
    sunk -= closed;
    const Span span = contacts.sub_contacts[c];
    for (Row s = span.first; s < span.end(); ++s)
        if (subs.normal_force[s] > 0 || subs.normal_displacement[s] < 0)
            subs.normal_force[s] += subs.normal_stiffness[s] * subs.area[s] * closed;
}

/// Sums of one contact's sub-contacts; pore pressure acts on both sides besides the effective stress.
void sum_contact(const Model& model, Row c, JointForces& forces) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Lanes3 n = Lanes3::of(contacts.normal[c]), origin = Lanes3::of(contacts.position[c]);
    const Span span = contacts.sub_contacts[c];
    const bool deformable =
        model.blocks.deformable[contacts.block1[c]] || model.blocks.deformable[contacts.block2[c]];
    const bool damped = joints_are_damped(model.settings);
    Lanes3 force = Lanes3::of(Vec3::Zero()), moment = force;
    for (Row i = 0; i < span.count; i += lane_count) {
        const LaneGroup group(span.count - i);
        const Row first = span.first + i;
        Lanes normal = group.load(subs.normal_force.data() + first) +
                       group.load(subs.pore_pressure.data() + first) * group.load(subs.area.data() + first);
        Lanes3 shear = group.load(subs.shear_force, first);
        if (damped) {
            normal += group.load(subs.dashpot_normal.data() + first);
            shear = shear + group.load(subs.dashpot_shear, first);
        }
        const Lanes3 f = n * normal + shear;
        if (deformable)
            for (Row k = 0; k < group.rows(); ++k) forces.of_sub_contact[first + k] = {f.x[k], f.y[k], f.z[k]};
        force = force + f;
        moment = moment + (group.load(subs.position, first) - origin).cross(f);
    }
    forces.of_contact[c] = sum(force);
    forces.moment[c] = sum(moment);
}

/// Marks a contact whose stiffness is another than it was.
void note_stiffness(const Model& model, Row c, JointForces& forces) {
    const auto& subs = model.sub_contacts;
    const Span span = model.contacts.sub_contacts[c];
    double sum = 0;
    for (Row s = span.first; s < span.end(); ++s)
        sum += std::max(subs.normal_stiffness[s], subs.shear_stiffness[s]) * subs.area[s];
    if (sum == forces.stiffness[c]) return;
    forces.stiffness[c] = sum;
    forces.stiffness_changed[c] = 1;
}

/// Geometry that was made after the last motion has not slid.
bool has_new_geometry(const Model& model, Row c) { return model.contacts.slid[c] == 0; }

void take_contact(const Model& model, Row c, JointForces& forces) {
    sum_contact(model, c, forces);
    note_stiffness(model, c, forces);
    if (has_new_geometry(model, c)) forces.stiffness_changed[c] = 1;
}

/// A joint model sees displacements at the start of the step; now they are those of its end.
void add_increments(SubContacts& subs, const Batch& batch) {
    const auto add = [&](Column<double>& sum, const Column<double>& part) {
        double* __restrict to = sum.data() + batch.first;
        const double* __restrict from = part.data() + batch.first;
        for (Row i = 0; i < batch.count; ++i) to[i] += from[i];
    };
    add(subs.normal_displacement, subs.normal_displacement_increment);
    for (int k = 0; k < 3; ++k)
        add(subs.shear_displacement.component[k], subs.shear_displacement_increment.component[k]);
}

/// Rate of work of the joints on the blocks with the forces as they are, times the step.
struct Work {
    double joint = 0, friction = 0;

    Work(const SubContacts& subs, const Batch& batch) {
        Lanes joints = Lanes::Zero(), frictions = Lanes::Zero();
        for (Row i = batch.first; i < batch.first + batch.count; i += lane_count) {
            const LaneGroup group(batch.first + batch.count - i);
            const Lanes opening = group.load(subs.normal_displacement_increment.data() + i);
            joints += group.load(subs.normal_force.data() + i) * opening +
                      group.load(subs.shear_force, i).dot(group.load(subs.shear_displacement_increment, i));
            frictions += group.load(subs.frictional_work.data() + i);
        }
        joint = sum(joints);
        friction = sum(frictions);
    }
};

/// Work of the pore pressure on the blocks; a joint model does not change it.
double fluid_work(const SubContacts& subs, const Batch& batch) {
    Lanes work = Lanes::Zero();
    for (Row i = batch.first; i < batch.first + batch.count; i += lane_count) {
        const LaneGroup group(batch.first + batch.count - i);
        work += group.load(subs.pore_pressure.data() + i) * group.load(subs.area.data() + i) *
                group.load(subs.normal_displacement_increment.data() + i);
    }
    return sum(work);
}

void combine(JointSums& sum, const JointSums& part) {
    sum.work += part.work;
    sum.friction += part.friction;
    sum.fluid += part.fluid;
    sum.damped += part.damped;
    sum.stiffness_changed = sum.stiffness_changed || part.stiffness_changed;
}

JointSums advance_batch(Model& model, const Batch& batch, JointForces& forces) {
    JointSums sums;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
    const bool energy = model.settings.energy;
    for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) {
        recover(model, c);
        move_contact(model, c);
    }
    auto columns = columns_of(model, batch, model.clock.time_step, history.data());
    std::optional<Work> before;
    if (energy) before.emplace(model.sub_contacts, batch);
    std::optional<BatchDashpots> dashpots;
    if (joints_are_damped(model.settings)) dashpots.emplace(model, batch);
    if (const auto failure = run_batch(*batch.model, columns)) throw joint_failure(model, batch, *failure);
    if (energy) {
        const Work after(model.sub_contacts, batch);
        sums.work = -0.5 * (before->joint + after.joint);
        sums.friction = after.friction - before->friction;
        sums.fluid = fluid_work(model.sub_contacts, batch);
    }
    if (dashpots) sums.damped = dashpots->finish();
    sums.stiffness_changed = columns.stiffness_changed;
    add_increments(model.sub_contacts, batch);
    for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) {
        sum_contact(model, c, forces);
        if (columns.stiffness_changed) note_stiffness(model, c, forces);
    }
    return sums;
}

} // namespace

JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces) {
    return reduce_chunks(
        batches.size(), 1, JointSums{},
        [&](std::size_t first, std::size_t) { return advance_batch(model, batches[first], forces); }, combine);
}

void joint_forces(const Model& model, JointForces& forces) {
    const bool any_deformable = model.zones.size() > 0;
    forces.of_sub_contact.assign(any_deformable ? model.sub_contacts.size() : 0, Vec3::Zero());
    forces.of_contact.assign(model.contacts.size(), Vec3::Zero());
    forces.moment.assign(model.contacts.size(), Vec3::Zero());
    forces.stiffness.assign(model.contacts.size(), 0);
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
