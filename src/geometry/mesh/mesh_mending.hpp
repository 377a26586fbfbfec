// Better zones in bad blocks by changes of the surfaces that they share with others. Private to geometry.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/mesh/neighbourhood.hpp"

namespace kaya {

/// In blocks with a bad angle, moves points in their faces and along their edges, swaps edges of triangles and divides some, where that
/// improves the worst zone of the block. Zones of adjacent blocks stay fair, unless they were worse already. A block without tetrahedra has
/// no mesh. The result does not depend on the order of blocks.
void mend_meshes(const MeshedBlocks& together, std::vector<TetMesh>& meshes, const ProgressCallback& progress);

} // namespace kaya
