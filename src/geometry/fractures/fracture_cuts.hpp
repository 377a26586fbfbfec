// Cuts blocks by fractures: over the whole block, or up to the rim of the fracture.
#pragma once

#include "geometry/fractures/fracture.hpp"
#include "geometry/surface/joint_set.hpp"

namespace kaya {

struct FractureCutting {
    bool limited = false;   ///< the cut ends where the fracture does
    int sides = 12;         ///< of the polygon that stands for a disc then
    double persistence = 1; ///< chance that a piece in the way of a fracture is cut, 0 to 1
    std::uint64_t seed = 0; ///< of persistence
    double thinnest = 0;    ///< thinner pieces are not made
    double nearest = 0;     ///< cuts that leave an edge shorter than this are not made
};

struct FractureCuts {
    CutBlocks blocks;
    double of_fractures = 0; ///< area inside of the blocks
    double of_joints = 0;    ///< area of the cuts
};

/// Cuts each block by the fractures that reach it, in their order; what a fracture only touches stays whole. The faces get the joint set of
/// the fracture. A limited cut divides the block by planes through the sides of the fracture, at right angles to it, and cuts the part
/// between them: the faces on the fracture are open, and all other faces between the pieces are to be joined. No plane divides a block
/// where the fracture does not end in it, so that a fracture which is wider than the block cuts as a joint set does.
FractureCuts cut_by_fractures(const std::vector<Polyhedron>& blocks, const std::vector<Fracture>& fractures,
                              const FractureCutting& how, const ProgressCallback& progress = {});

} // namespace kaya
