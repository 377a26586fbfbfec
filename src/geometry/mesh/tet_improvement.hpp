// Better shapes for a mesh of tetrahedra. Private to geometry.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/mesh/mesh_points.hpp"
#include "geometry/mesh/tet_exchanges.hpp"

#include <array>
#include <vector>

namespace kaya {

/// Moves points inside and exchanges tetrahedra around badly shaped ones while the worst of each neighbourhood improves, for a limited
/// number of rounds. The surface is unchanged. Tetrahedra without volume are removed where possible.
void improve(MeshPoints& points, std::vector<std::array<int, 4>>& tetrahedra, bool new_points,
             const ProgressCallback& progress = {});

/// The sine of an angle that is good enough.
constexpr double good_sine = 0.309;

/// The same for tetrahedra of block 0 whose least sine of a dihedral angle is below `wanted`, in a mesh whose points on faces have their
/// own admissible motion.
void improve_angles(ChangeableTets& mesh, double wanted, const ProgressCallback& progress);

} // namespace kaya
