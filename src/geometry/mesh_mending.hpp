// Better zones in bad blocks by changes of the surfaces that they share with others. Private to geometry.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/neighbourhood.hpp"

namespace kaya {

/// In blocks with a bad angle, moves points of faces in them and points of edges along them, turns edges of triangles and divides some, where that
/// makes the worst zone of the block better. Zones of the blocks beside it get no worse than fair by that, if they are not already.
/// A block without tetrahedra has no mesh. What comes out does not depend on the order of blocks.
void mend_meshes(const MeshedBlocks& together, std::vector<TetMesh>& meshes, const ProgressCallback& progress);

} // namespace kaya
