// Blocks of the model that are cut into pieces.
#pragma once

#include "geometry/surface/joint_set.hpp"
#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Replaces cut blocks by their pieces: the first piece keeps number and id of its block, the others are new blocks with the same material,
/// region, group, velocity field, fixity and velocity histories. Loads stay at their places; those through the centroid are shared by
/// volume. Faces keep their groups. Pieces of a joined body on either side of a cut are separated: pieces of two blocks that were joined
/// stay joined where they are in contact. `rows` are the rigid blocks that were considered, in the order that the cut uses. Returns the row
/// of each piece.
std::vector<Row> replace_by_pieces(Model& model, const std::vector<Row>& rows, const CutBlocks& cut);

} // namespace kaya
