// What slip does to joints: shear turns into its direction, and some joints remember it.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Looks at how far joints have slipped since it was made. Shear across the direction of slip fades as exp(-s/d), s the slip and d = shear stress
/// over stiffness: docs/theory/slopes.md.
class Slip {
public:
    explicit Slip(const Model& model) : work_(model.sub_contacts.frictional_work), ids_(model.sub_contacts.id) {}

    /// Sub-contacts between what slides and what stays: they have slipped at least half as far as those that slip do in the mean. None when contacts are others now.
    std::vector<Row> rows(const Model& model) const;
    /// Whether these have slipped so far that a thousandth of that shear is left.
    bool has_turned_shear(const Model& model) const;

private:
    double path(const SubContacts& subs, std::size_t row) const;

    std::vector<double> work_;
    std::vector<SubContactId> ids_;
};

/// Joints that are closed keep their forces and forget all else that slip has made of them; zones remember what those of `start`, the same
/// model before it slid, do.
void forget_slip(Model& model, const Model& start, JointRegistry& joints);

} // namespace kaya
