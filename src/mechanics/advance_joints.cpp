#include "base/diagnostic.hpp"
#include "base/reduce.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace kaya {

namespace {

/// Sums of one contact's sub-contacts; pore pressure acts on both sides besides the effective stress.
void sum_contact(const Model& model, Row c, JointForces& forces) {
    const auto& subs = model.sub_contacts;
    const auto& contacts = model.contacts;
    const Vec3 n = contacts.normal[c], o = contacts.position[c];
    const Span span = contacts.sub_contacts[c];
    const bool deformable =
        model.blocks.deformable[contacts.block1[c]] || model.blocks.deformable[contacts.block2[c]];
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (Row s = span.first; s < span.end(); ++s) {
        const double normal = subs.normal_force[s] + subs.pore_pressure[s] * subs.area[s];
        const Vec3 f = normal * n + subs.shear_force[s];
        const Vec3 arm = subs.position[s] - o;
        if (deformable) forces.of_sub_contact[s] = f;
        force += f;
        moment += arm.cross(f);
    }
    forces.of_contact[c] = force;
    forces.moment[c] = moment;
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
    double joint = 0, fluid = 0, friction = 0;

    Work(const SubContacts& subs, const Batch& batch) {
        const auto column = [&](const Column<double>& c) { return c.data() + batch.first; };
        const double *fn = column(subs.normal_force), *un = column(subs.normal_displacement_increment);
        const double *pressure = column(subs.pore_pressure), *area = column(subs.area);
        const double* lost = column(subs.frictional_work);
        std::array<const double*, 3> fs, us;
        for (int k = 0; k < 3; ++k) {
            fs[k] = column(subs.shear_force.component[k]);
            us[k] = column(subs.shear_displacement_increment.component[k]);
        }
        for (Row i = 0; i < batch.count; ++i) {
            joint += fn[i] * un[i] + fs[0][i] * us[0][i] + fs[1][i] * us[1][i] + fs[2][i] * us[2][i];
            fluid += pressure[i] * area[i] * un[i];
            friction += lost[i];
        }
    }
};

void combine(JointSums& sum, const JointSums& part) {
    sum.work += part.work;
    sum.friction += part.friction;
    sum.fluid += part.fluid;
    sum.stiffness_changed = sum.stiffness_changed || part.stiffness_changed;
}

JointSums advance_batch(Model& model, const Batch& batch, JointForces& forces) {
    JointSums sums;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
    const bool energy = model.settings.energy;
    for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) move_contact(model, c);
    auto columns = columns_of(model, batch, model.clock.time_step, history.data());
    std::optional<Work> before;
    if (energy) before.emplace(model.sub_contacts, batch);
    if (const auto failure = run_batch(*batch.model, columns)) throw joint_failure(model, batch, *failure);
    if (energy) {
        const Work after(model.sub_contacts, batch);
        sums.work = -0.5 * (before->joint + after.joint);
        sums.friction = after.friction - before->friction;
        sums.fluid = after.fluid;
    }
    sums.stiffness_changed = columns.stiffness_changed;
    add_increments(model.sub_contacts, batch);
    for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) sum_contact(model, c, forces);
    return sums;
}

} // namespace

JointSums advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces) {
    return reduce_chunks(
        batches.size(), 1, JointSums{},
        [&](std::size_t first, std::size_t) { return advance_batch(model, batches[first], forces); }, combine);
}

void joint_forces(const Model& model, JointForces& forces) {
    forces.of_sub_contact.assign(model.sub_contacts.size(), Vec3::Zero());
    forces.of_contact.assign(model.contacts.size(), Vec3::Zero());
    forces.moment.assign(model.contacts.size(), Vec3::Zero());
    for (std::size_t c = 0; c < model.contacts.size(); ++c) sum_contact(model, static_cast<Row>(c), forces);
}

} // namespace kaya
