// Cuts blocks by a ground surface.
#pragma once

#include "geometry/ground/ground.hpp"
#include "geometry/surface/joint_set.hpp"

#include <vector>

namespace kaya {

/// Cuts each block into convex pieces above or below the surface, as few as its folds require: deep rock stays in one piece. Blocks that
/// the surface does not reach stay whole, and so does rock outside its plan; none counts as swallowed. Planes are continued in blocks that reach beyond it. Pieces are not thinner than `thinnest`. Throws Diagnostic when
/// there would be too many pieces for any machine.
SidedBlocks cut_by_ground(const std::vector<Polyhedron>& blocks, const Ground& ground, int id, double thinnest,
                          const ProgressCallback& progress = {});

} // namespace kaya
