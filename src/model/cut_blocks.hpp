// Blocks of the model that are cut into pieces.
#pragma once

#include "geometry/joint_set.hpp"
#include "model/model.hpp"

#include <vector>

namespace kaya {

/// Puts the pieces in place of the blocks that were cut: the first piece keeps number and id of its block, the
/// others are new blocks with the same material, region, group, velocity field and fixity, and whatever drives it; loads
/// are shared by volume, and faces keep their groups. Of a body of joined blocks the pieces on either side of a cut are parted: pieces of two blocks that
/// were joined stay joined where they touch. `rows` are the rigid blocks that were looked at, in the order in which the cut knows them. Returns the row of each piece.
std::vector<Row> replace_by_pieces(Model& model, const std::vector<Row>& rows, const CutBlocks& cut);

} // namespace kaya
