// What the springs of a contact are to the time step: the one place that says how stiff a sub-contact is.
#pragma once

#include "model/model.hpp"

#include <algorithm>

namespace kaya {

/// Tangent stiffnesses of a sub-contact times its area, force/length.
struct Springs {
    double normal = 0, shear = 0;

    double stiffer() const { return std::max(normal, shear); }
};

/// Times by which the area of a contact that counts for its normal stiffness exceeds those of its sub-contacts.
inline double normal_area_factor(const Model& model, Row contact) {
    const double area = model.contacts.area[contact], stiff = model.contacts.stiffness_area[contact];
    return stiff > 0 && area > 0 ? stiff / area : 1;
}

/// `factor`: normal_area_factor of its contact.
inline Springs springs_of(const SubContacts& subs, Row s, double factor) {
    return {subs.normal_stiffness[s] * subs.area[s] * factor, subs.shear_stiffness[s] * subs.area[s]};
}

/// Sum over the contact's sub-contacts of the larger stiffness, force/length.
double sum_of_stiffness(const Model& model, Row contact);

/// Trace of the contact's stiffness over the masses and moments of inertia of its rigid blocks, 1/time^2: no eigenvalue
/// of the contact alone is greater. 0 for blocks that are fixed.
double stiffness_over_mass(const Model& model, Row contact);

} // namespace kaya
