// What holds joined blocks with zones together.
#pragma once

#include "joints/joint_model.hpp"
#include "model/model.hpp"

namespace kaya {

/// The number of the joint material that glue has; no deck can give properties to it.
inline constexpr std::int32_t material_of_glue = -1;

/// Gives the contacts inside joined bodies springs in place of a joint: elastic, without a strength, whatever joint
/// model or properties commands have given them since. A spring is as stiff as a layer of the body whose thickness is a
/// tenth of an edge of its zones (docs/theory/motion.md). Throws Diagnostic when such a block has no moduli.
void glue_joined_blocks(Model& model, JointRegistry& joints);

} // namespace kaya
