// Properties of joints that must be there before they move.
// reads: contacts.properties, joint_properties
// writes: nothing
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

namespace kaya {

/// Throws Diagnostic for joint properties that must be given and are not, and for values that do not go together.
void check_properties(const Model& model, JointRegistry& joints);

} // namespace kaya
