// Properties of joints that must be there before they move.
// reads: contacts.properties, joint_properties
// writes: nothing
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

namespace kaya {

/// Throws Diagnostic for required joint properties that are missing, and for values that contradict each other.
void check_properties(const Model& model, JointRegistry& joints);

} // namespace kaya
