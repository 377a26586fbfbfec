#include "mechanics/contact/carried_load.hpp"

#include "mechanics/contact/contact_work.hpp"

namespace kaya {

CarriedLoad::CarriedLoad(const Model& model, Row c) : worn(frictional_work(model, c)) {
    const auto& subs = model.sub_contacts;
    const Row first = model.contacts.sub_contacts[c].first;
    for (Row s = first; s < first + carriers; ++s) {
        force += subs.normal_force[s];
        stiffness += subs.normal_stiffness[s] * subs.area[s];
        const auto k = static_cast<std::size_t>(s - first);
        shear[k] = held[k] = subs.shear_force[s];
        worn_by_row[k] = subs.frictional_work[s];
        shear_stiffness[k] = subs.shear_stiffness[s];
    }
    for (Row k = 0; k < 2; ++k) {
        normal[static_cast<std::size_t>(k)] = subs.normal_force[first + k];
        normal_stiffness[static_cast<std::size_t>(k)] = subs.normal_stiffness[first + k];
    }
}

} // namespace kaya
