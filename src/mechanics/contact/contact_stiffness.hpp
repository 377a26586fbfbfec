// The springs of a contact as the time step sees them: the only place that defines the stiffness of a sub-contact.
#pragma once

#include "mechanics/lanes/eight.hpp"
#include "mechanics/lanes/triple.hpp"
#include "mechanics/shape/overlap_patch.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace kaya {

/// Tangent stiffnesses of a sub-contact times its area, force/length.
struct Springs {
    double normal = 0, shear = 0;

    double stiffer() const { return std::max(normal, shear); }
};

/// Ratio of the area that counts for the stiffness of a contact to that of its sub-contacts. Of an overlap, loaded sub-contacts
/// count: they may have nearly no area, while the others still have that of the former joint.
struct NormalAreaFactor {
    double of_carriers = 1;
    Row others = std::numeric_limits<Row>::max(); ///< the first unloaded one

    NormalAreaFactor(const Model& model, Row contact) {
        const bool overlap = model.contacts.kind[contact] == ContactKind::overlap;
        const Row first = model.contacts.sub_contacts[contact].first;
        const double area = overlap ? carriers * model.sub_contacts.area[first] : model.contacts.area[contact],
                     stiff = model.contacts.stiffness_area[contact];
        if (!(stiff > 0 && area > 0)) return;
        of_carriers = stiff / area;
        if (overlap) others = first + carriers;
    }
    double of(Row s) const { return s < others ? of_carriers : 1; }
    /// Of the eight rows from `first` on.
    Eight of_eight(Row first) const {
        constexpr Eight places{0, 1, 2, 3, 4, 5, 6, 7};
        return places < static_cast<double>(others) - first ? eights(of_carriers) : eights(1);
    }
    /// Of the eight rows from `first` on, places relative to that of the contact: unloaded ones count as there.
    Eight3 arms(Row first, const Eight3& arm) const {
        constexpr Eight places{0, 1, 2, 3, 4, 5, 6, 7};
        const double loaded = static_cast<double>(others) - first;
        const auto kept = [&](const Eight& e) { return places < loaded ? e : Eight{}; };
        return {kept(arm.x), kept(arm.y), kept(arm.z)};
    }
};

/// `factor`: that of its contact.
inline Springs springs_of(const SubContacts& subs, Row s, const NormalAreaFactor& factor) {
    const double area = subs.area[s] * factor.of(s);
    return {subs.normal_stiffness[s] * area, subs.shear_stiffness[s] * area};
}

struct SpringsOfEight {
    Eight normal, shear;
};

/// The same of up to eight sub-contacts from `first` on; missing ones have none.
inline SpringsOfEight springs_of(const SubContacts& subs, Row first, const RowsOfEight& group,
                                 const NormalAreaFactor& factor) {
    const Eight area = group.load(subs.area.data() + first) * factor.of_eight(first);
    return {group.load(subs.normal_stiffness.data() + first) * area,
            group.load(subs.shear_stiffness.data() + first) * area};
}

/// Sum over the contact's sub-contacts of the larger stiffness, force/length.
double sum_of_stiffness(const Model& model, Row contact);

/// One number for each block of a contact.
using StiffnessOfSides = std::array<double, 2>;

/// Inverses of the true mass and inertia of a rigid block, in its own axes.
struct Compliance {
    double of_mass;
    SymmetricInverse of_inertia;
};

/// Of each block; undefined for blocks that have zones or no mass.
std::vector<Compliance> compliances_of(const Model& model);

/// Trace of an overlap contact's stiffness over the mass and the moments of inertia of each of its rigid blocks, 1/time^2: an upper bound for the
/// eigenvalues of the contact alone. 0 for fixed blocks. Masses are the true ones. `compliances` are those of all blocks.
StiffnessOfSides stiffness_over_mass(const Model& model, const std::vector<Compliance>& compliances, Row contact);

} // namespace kaya
