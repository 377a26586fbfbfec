// Forces that joint models find when they are given to joints, or that scripts set.
// reads: forces_set, taken_over, sub_contacts.normal_force, sub_contacts.shear_force
// writes: sub_contacts, forces_set, taken_over, energy.joint_friction
#pragma once

#include "base/diagnostic.hpp"
#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Notes sub-contacts whose joint model or forces were set by a command.
void note_taken_over(Model& model, const std::vector<char>& marked);

/// Lets the joint models know of forces that scripts have set since the last call.
void tell_of_forces(Model& model, JointRegistry& joints);

/// Asks the joint models of what was noted for a step without motion. Forces that they do not carry become what they make of
/// them, and there is a warning for each joint model that says which and how much; all others stay as they are to the last bit.
/// Sub-contacts whose property set is not complete yet stay noted. Throws Diagnostic when a joint model fails.
std::vector<Diagnostic> take_over_forces(Model& model, JointRegistry& joints);

} // namespace kaya
