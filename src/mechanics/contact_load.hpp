// What passes through a contact and what its springs hold.
#pragma once

#include "model/lanes.hpp"
#include "model/model.hpp"

namespace kaya {

struct ContactLoad {
    double energy = 0;       ///< in the normal springs of its sub-contacts, or in its overlap
    double shear_energy = 0; ///< in their shear springs
    double normal = 0;       ///< sum of their normal forces
    double shear = 0;        ///< sum of the sizes of their shear forces
    Vec3 shear_sum = Vec3::Zero();

    ContactLoad() = default;
    ContactLoad(const Model& model, Row c) {
        const auto& subs = model.sub_contacts;
        const Span span = model.contacts.sub_contacts[c];
        for (Row s = span.first; s < span.end(); s += lane_count) {
            const LaneGroup group(span.end() - s);
            const Lanes area = group.load(subs.area.data() + s), force = group.load(subs.normal_force.data() + s);
            const Lanes3 along = group.load(subs.shear_force, s);
            const Lanes squared = along.dot(along);
            energy += in_springs(force * force, group.load(subs.normal_stiffness.data() + s) * area);
            shear_energy += in_springs(squared, group.load(subs.shear_stiffness.data() + s) * area);
            normal += sum(force);
            shear_sum += sum(along);
            shear += sum(squared.sqrt());
        }
        if (model.contacts.kind[c] == ContactKind::overlap && model.settings.large_strain)
            energy = model.contacts.energy_taken[c];
    }
    double stored() const { return energy + shear_energy; }

private:
    /// Where there is no stiffness there is no spring.
    static double in_springs(const Lanes& force_squared, const Lanes& stiffness) {
        Lanes energy;
        for (Row i = 0; i < lane_count; ++i) energy[i] = stiffness[i] > 0 ? 0.5 * force_squared[i] / stiffness[i] : 0;
        return sum(energy);
    }
};

} // namespace kaya
