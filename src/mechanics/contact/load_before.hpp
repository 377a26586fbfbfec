// Loads of contacts before their geometry is rebuilt: rebuilding must not create energy.
#pragma once

#include "mechanics/contact/contact_load.hpp"
#include "mechanics/contact/contact_draft.hpp"
#include "mechanics/contact/plane_motion.hpp"
#include "laws/joint_model.hpp"

#include <vector>

namespace kaya {

class LoadBefore {
public:
    /// For the contact that a draft gives new geometry.
    LoadBefore(const Model& model, Row draft, Row old);

    /// Removes from the contact, now at row `contact`, the energy that its new geometry would create. `moving`: changed forces have acted
    /// during half of the step. Returns the energy lost from its springs.
    double settle(Model& model, const JointRegistry& joints, Row contact, bool moving) const;

    Row row; ///< of the draft
    ContactLoad load;
    PlaneMotion motion; ///< in small strain, where places do not show it

private:
    bool overlap_; ///< it was one
    double work_;  ///< work of its forces in the step
};

/// For all contacts with new geometry.
std::vector<LoadBefore> loads_of(const Model& model, const std::vector<ContactDraft>& drafts);

/// The energy in the springs of deleted contacts.
double stored_in_parted(const Model& model, const std::vector<char>& kept);
/// Before blocks are deleted: counts the energy in the springs of their joints as lost in contact updates, where there is an account.
void lose_joints_of(Model& model, const std::vector<Row>& blocks);

} // namespace kaya
