#include "base/diagnostic.hpp"
#include "base/parallel.hpp"
#include "mechanics/phases.hpp"

#include <Eigen/Geometry>
#include <array>
#include <atomic>

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

} // namespace

bool advance_joints(Model& model, const std::vector<Batch>& batches, JointForces& forces) {
    std::atomic<bool> stiffness_changed = false;
    for_chunks(batches.size(), 1, [&](std::size_t first, std::size_t last) {
        std::array<double*, KAYA_JMODEL_MAX_HISTORY> history;
        for (std::size_t i = first; i < last; ++i) {
            const Batch& batch = batches[i];
            for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) move_contact(model, c);
            auto columns = columns_of(model, batch, model.clock.time_step, history.data());
            if (const auto failure = run_batch(*batch.model, columns)) throw joint_failure(model, batch, *failure);
            if (columns.stiffness_changed) stiffness_changed.store(true, std::memory_order_relaxed);
            add_increments(model.sub_contacts, batch);
            for (Row c = batch.contacts.first; c < batch.contacts.end(); ++c) sum_contact(model, c, forces);
        }
    });
    return stiffness_changed;
}

void joint_forces(const Model& model, JointForces& forces) {
    forces.of_sub_contact.assign(model.sub_contacts.size(), Vec3::Zero());
    forces.of_contact.assign(model.contacts.size(), Vec3::Zero());
    forces.moment.assign(model.contacts.size(), Vec3::Zero());
    for (std::size_t c = 0; c < model.contacts.size(); ++c) sum_contact(model, static_cast<Row>(c), forces);
}

} // namespace kaya
