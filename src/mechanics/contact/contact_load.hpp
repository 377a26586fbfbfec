// The force through a contact and the energy in its springs.
#pragma once

#include "mechanics/contact/overlap_shear.hpp"
#include "mechanics/lanes/eight.hpp"
#include "mechanics/shape/overlap_patch.hpp"
#include "model/tables/model.hpp"

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
        const bool curved = model.contacts.curved[c] != 0 && between_rigid(model, c);
        for (Row s = span.first; s < span.end(); s += eight) {
            const RowsOfEight group(span.end() - s);
            const Eight area = group.load(subs.area.data() + s), force = group.load(subs.normal_force.data() + s);
            const Eight3 along = group.load(subs.shear_force, s);
            const Eight squared = along.dot(along);
            const Eight stiffness = group.load(subs.normal_stiffness.data() + s) * area;
            const Eight stored = curved ? in_power(force, stiffness, -group.load(subs.normal_displacement.data() + s))
                                        : in_springs(force * force, stiffness);
            const Eight whole =
                sums_of({stored, in_springs(squared, group.load(subs.shear_stiffness.data() + s) * area), force,
                         square_root(squared), along.x, along.y, along.z, Eight{}});
            energy += whole[0];
            shear_energy += whole[1];
            normal += whole[2];
            shear += whole[3];
            shear_sum += Vec3(whole[4], whole[5], whole[6]);
        }
        if (model.contacts.kind[c] == ContactKind::overlap && model.settings.large_strain) {
            energy = model.contacts.energy_taken[c];
            shear_energy = kaya::shear_energy(model, c);
        }
    }
    double stored() const { return energy + shear_energy; }

private:
    /// Without stiffness there is no spring.
    static Eight in_springs(const Eight& force_squared, const Eight& stiffness) {
        return stiffness > 0 ? 0.5 * force_squared / stiffness : Eight{};
    }
    /// Energy of springs whose force is a power of the closure, which is at least that of a straight one: docs/theory/contacts.md, (10g).
    static Eight in_power(const Eight& force, const Eight& stiffness, const Eight& displacement) {
        const Eight closure = larger_of(stiffness > 0 ? force / stiffness : Eight{}, displacement);
        return force > 0 ? force * force * closure / (force + stiffness * closure)
                         : in_springs(force * force, stiffness);
    }
};

} // namespace kaya
