// Effect of slip on joints: shear turns into the direction of slip, and some joints have a history.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Slip of joints since its construction. Shear across the direction of slip decays as exp(-s/d), s the slip and d = shear stress over
/// stiffness: docs/theory/slopes.md.
class Slip {
public:
    explicit Slip(const Model& model) : work_(model.sub_contacts.frictional_work), ids_(model.sub_contacts.id) {}

    /// Whether the contacts are those of its construction.
    bool follows(const Model& model) const;
    /// Sub-contacts between the sliding part and the rest: their slip is at least half the mean of those that slip. None when contacts have
    /// changed.
    std::vector<Row> rows(const Model& model) const;
    /// Whether these have slipped so far that a thousandth of that shear is left.
    bool has_turned_shear(const Model& model) const;

private:
    double path(const SubContacts& subs, std::size_t row) const;

    std::vector<double> work_;
    std::vector<SubContactId> ids_;
};

/// Closed joints keep their forces and lose the rest of their slip history; zones get the history of `start`, the same model before it
/// slid.
void forget_slip(Model& model, const Model& start, JointRegistry& joints);

} // namespace kaya
