// The planes of a set of parallel joints, and cutting blocks by them.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/polyhedra/cut.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

/// One family of joints as a deck describes it. Angles in degrees, deviations are half widths of
/// uniform scatter: every joint has its own dip, dip direction and place.
struct JointSet {
    double dip = 0, dip_deviation = 0;
    double dip_direction = 0, dip_direction_deviation = 0;
    double spacing = 0, spacing_deviation = 0; ///< along the normal of the mean plane
    int number = 1;                            ///< of joints; the first passes through the origin
    Vec3 origin = Vec3::Zero();
    double tolerance = 0;   ///< a cut that would pass nearer to a vertex of a block is not made
    double persistence = 1; ///< chance that a block in the way of a joint is cut, 0 to 1
    int id = 1;             ///< kept on the faces that the set cuts
    std::uint64_t seed = 0; ///< scatter and persistence follow from seed and id alone
};

/// The planes: through the origin, then one spacing above, one below, two above, ... Scatter of spacing
/// moves a joint from its regular place. Throws Diagnostic when a number is out of its limits
/// (spacing must be above 0 as soon as there are two joints).
std::vector<Plane> joint_planes(const JointSet& set);

/// Result for the blocks.
struct CutBlocks {
    struct Piece {
        Polyhedron polyhedron;
        int parent = 0; ///< the block that it was cut from, an index of the input
    };
    std::vector<Piece> pieces; ///< of blocks that were cut only; those of one parent follow each other
    std::vector<int> parents;  ///< blocks that were cut, rising
    int slivers = 0;           ///< cuts that were refused
    int corners = 0;           ///< cuts that were refused since they would pass too near to a vertex
};

/// Result for blocks that a surface divides: a tunnel, the ground, an ore body.
struct SidedBlocks {
    CutBlocks blocks;
    std::vector<bool> inside;   ///< for each piece: within the outline or the body, below the ground
    std::vector<int> swallowed; ///< blocks entirely within, not cut
    std::vector<int> beyond;    ///< blocks that were cut, and in which the rim of the ground lies
};

/// Cuts each block by all planes of the set. Which blocks a joint of persistence below 1 leaves whole
/// depends on seed, id, joint and the block's place in the list alone.
/// Throws Diagnostic as joint_planes does, and when the set would make more blocks than any machine can hold.
CutBlocks cut_blocks(const std::vector<Polyhedron>& blocks, const JointSet& set, double thinnest = 0,
                     const ProgressCallback& progress = {});

} // namespace kaya
