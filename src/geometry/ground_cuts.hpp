// Cutting blocks by a ground surface.
#pragma once

#include "geometry/ground.hpp"
#include "geometry/joint_set.hpp"

#include <vector>

namespace kaya {

struct GroundCut {
    CutBlocks blocks;
    std::vector<bool> above; ///< for each piece: above the surface
};

/// Cuts each block into convex pieces that lie above or below the surface, as few as its folds ask for: deep rock stays in one
/// piece. Blocks that the surface does not reach stay whole, and so does what lies outside of its plan.
/// Pieces are not thinner than `thinnest`. Throws Diagnostic when there would be more than any machine can hold.
GroundCut cut_by_ground(const std::vector<Polyhedron>& blocks, const Ground& ground, int id, double thinnest,
                        const ProgressCallback& progress = {});

} // namespace kaya
