// What commands have given to the joints of a block stays with the pieces that the block is cut into.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// A joint that has another material, other properties or another group than one that is found anew.
struct GivenJoint {
    BlockId block1, block2;
    std::int32_t material = 0;
    Row properties = 0;
    std::int32_t group = 0;
};

/// The given joints of the blocks, which are about to be cut.
std::vector<GivenJoint> given_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks);

/// Finds the contacts of the pieces and gives them what the joints of the whole blocks had. `origin`: by row of block,
/// the block that it was, which keeps its id as first piece. Does nothing when there are no given joints.
void give_to_pieces(Model& model, JointRegistry& joints, const std::vector<GivenJoint>& given,
                    const std::vector<BlockId>& origin);

} // namespace kaya
