// Pieces of a cut block inherit what commands have given to its joints.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// A joint whose material, properties or group differ from those of a newly found one.
struct GivenJoint {
    BlockId block1, block2;
    std::int32_t material = 0;
    Row properties = 0;
    std::int32_t group = 0;
};

/// The given joints of blocks that are about to be cut.
std::vector<GivenJoint> given_joints(Model& model, JointRegistry& joints, const std::vector<Row>& blocks);

/// Finds the contacts of the pieces and gives them the data of the joints of the whole blocks. `origin`: by row of block, the block from
/// which it was cut, which keeps its id as first piece. Does nothing when there are no given joints.
void give_to_pieces(Model& model, JointRegistry& joints, const std::vector<GivenJoint>& given,
                    const std::vector<BlockId>& origin);

} // namespace kaya
