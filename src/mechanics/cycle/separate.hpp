// Separates joined blocks, whose joints then carry what was within the bodies.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Separates the bodies with any of the blocks. Joints between rigid blocks begin as those of a cut (parted_joints.hpp), joints between zones
/// with the stress of their zones.
void separate(Model& model, JointRegistry& joints, const std::vector<Row>& blocks);

} // namespace kaya
