// What the springs of a contact are to the time step: the one place that says how stiff a sub-contact is.
#pragma once

#include "mechanics/overlap_patch.hpp"
#include "model/model.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace kaya {

/// Tangent stiffnesses of a sub-contact times its area, force/length.
struct Springs {
    double normal = 0, shear = 0;

    double stiffer() const { return std::max(normal, shear); }
};

/// Times by which the area that counts for the normal stiffness of a contact exceeds that of its sub-contacts. Of an overlap
/// those that carry count: they may have next to no area, while the others have that of the joint that was there.
struct NormalAreaFactor {
    double of_carriers = 1;
    Row others = std::numeric_limits<Row>::max(); ///< the first one that carries nothing

    NormalAreaFactor(const Model& model, Row contact) {
        const double area = model.contacts.area[contact], stiff = model.contacts.stiffness_area[contact];
        if (!(stiff > 0 && area > 0)) return;
        of_carriers = stiff / area;
        if (model.contacts.kind[contact] == ContactKind::overlap)
            others = model.contacts.sub_contacts[contact].first + carriers;
    }
    double of(Row s) const { return s < others ? of_carriers : 1; }
};

/// `factor`: that of its contact.
inline Springs springs_of(const SubContacts& subs, Row s, const NormalAreaFactor& factor) {
    return {subs.normal_stiffness[s] * subs.area[s] * factor.of(s), subs.shear_stiffness[s] * subs.area[s]};
}

/// Sum over the contact's sub-contacts of the larger stiffness, force/length.
double sum_of_stiffness(const Model& model, Row contact);

/// One number for each block of a contact.
using StiffnessOfSides = std::array<double, 2>;

/// Trace of the contact's stiffness over the mass and the moments of inertia of each of its rigid blocks, 1/time^2: no eigenvalue
/// of the contact alone is greater. 0 for blocks that are fixed. Masses are the true ones.
StiffnessOfSides stiffness_over_mass(const Model& model, Row contact);

} // namespace kaya
