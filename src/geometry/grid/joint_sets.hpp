// Joint sets between the blocks of a grid. Faces of neighbours need not fit, and zones have none: blocks are compared by place.
#pragma once

#include "geometry/grid/grid3d.hpp"

#include <functional>
#include <vector>

namespace kaya {

/// The pairs of blocks whose faces of one joint set lie against each other; the sets by number. A face without a set counts as one of the
/// other's set.
std::vector<Grid3d::JointSet> joint_sets_between(const std::vector<GridShape>& blocks);

/// Gives the faces between two blocks of a pair the joint set of the pair. `parts_of` has the solid that was made of the block with a number;
/// null: none.
void give_joint_sets(const Grid3d& grid, const std::function<std::vector<Polyhedron>*(int)>& parts_of);

} // namespace kaya
