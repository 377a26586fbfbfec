// Relative motion of eight pairs of rigid blocks in a step.
#pragma once

#include "mechanics/lanes/triple.hpp"
#include "model/tables/model.hpp"

#include <span>

namespace kaya {

/// Relative motion is linear in position, so a few numbers per contact serve all its sub-contacts. They are computed for eight contacts at
/// a time: one by one, the sums would wait for each other.
struct PairMotions {
    Eight3 origin;            ///< of the plane, before the step
    Eight3 normal;            ///< after it
    Eight3 normal_middle;     ///< mean of the normals before and after
    Eight3 apart, apart_turn; ///< displacement of block 2 at the origin relative to block 1, and rotation
    Eight3 mean, mean_turn;   ///< means of both blocks
    Eight twist;              ///< of the mean turn, about the normal

    /// Takes up to eight contacts. In large strain it turns the planes of joints between rigid blocks with the blocks that own the faces,
    /// and moves their origins with the mean of the blocks. The lanes of other contacts are undefined.
    void take(Model& model, std::span<const Row> contacts);
};

} // namespace kaya
