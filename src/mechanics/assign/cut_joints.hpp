// Joints of cut blocks go over to the pieces, with all that they carry.
#pragma once

#include "laws/joint_model.hpp"
#include "mechanics/contact/plane_motion.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// A joint of a block that is about to be cut.
struct WholeJoint {
    ContactId contact;
    BlockId block1, block2;
    Vec3 centroid1; ///< of block1
    PlaneMotion motion;
};

/// The joints of blocks that are about to be cut: once the model has moved or carries forces, all of them, before only those whose material,
/// properties or group differ from those of a newly found one.
std::vector<WholeJoint> whole_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks);

/// Finds the contacts of the pieces. Each takes from the joint of the whole blocks, if there was one at its place, tractions, displacements,
/// state, history, properties and group. `origin`: by row of block, the block from which it was cut, which keeps its id as first piece. Does
/// nothing when there are no such joints.
void share_joints(Model& model, JointRegistry& joints, const std::vector<WholeJoint>& whole,
                  const std::vector<BlockId>& origin);

} // namespace kaya
