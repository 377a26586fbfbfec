// Forces that joint models find when they are given to joints, or that scripts set.
// reads: forces_set, taken_over, sub_contacts.normal_force, sub_contacts.shear_force
// writes: sub_contacts, forces_set, taken_over, energy.joint_friction
#pragma once

#include "base/diagnostic.hpp"
#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Notes sub-contacts whose joint model or forces were set by a command.
void note_taken_over(Model& model, const std::vector<char>& marked);

/// Passes forces that scripts have set since the last call to the joint models.
void tell_of_forces(Model& model, JointRegistry& joints);

/// Runs the joint models of the noted sub-contacts for a step without motion. Forces that they do not carry are replaced by theirs, with a
/// warning for each joint model about the place and the size; all other forces are unchanged to the last bit. Sub-contacts with an
/// incomplete property set remain noted. Throws Diagnostic when a joint model fails.
std::vector<Diagnostic> take_over_forces(Model& model, JointRegistry& joints);

} // namespace kaya
