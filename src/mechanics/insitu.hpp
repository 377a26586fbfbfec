// The stress that is in the ground before anything happens.
#pragma once

#include "joints/joint_model.hpp"
#include "mechanics/boundary.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Gives zones the stress at their centroid, and sub-contacts the forces with which that stress acts on their area:
/// with n from block 1 to block 2, -n.s.n of normal stress (compression positive) and the rest of -s.n as shear.
/// Forces beyond what a joint bears are cut by its model in the next cycle. Displacements stay as they are.
/// Contacts must have been found. `zones` and `sub_contacts` are ascending rows.
void set_insitu_stress(Model& model, JointRegistry& joints, const std::vector<Row>& zones,
                       const std::vector<Row>& sub_contacts, const StressField& stress);

} // namespace kaya
