// The blocks in the meshes of VTK. Private to geometry.
#pragma once

#include "geometry/grid/grid3d.hpp"
#include "geometry/read/vtk_mesh.hpp"

namespace kaya {

/// Without blocks when all cells are faces. Throws Diagnostic when there is neither a cell nor a face.
Grid3d blocks_of(const VtkMesh& mesh);

} // namespace kaya
