// Eight pairs of rigid blocks, one step on, as their contacts see them.
#pragma once

#include "mechanics/triple.hpp"
#include "model/model.hpp"

#include <span>

namespace kaya {

/// Relative motion is linear in the place, so that a few numbers per contact serve all its sub-contacts. They are found for eight
/// contacts at a time: one after another the same sums would wait for each other.
struct PairMotions {
    Eight3 origin;            ///< of the plane, before the step
    Eight3 normal;            ///< after it
    Eight3 normal_middle;     ///< mean of the normals before and after
    Eight3 apart, apart_turn; ///< way of block 2 at the origin as seen from block 1, and turn
    Eight3 mean, mean_turn;   ///< means of both blocks
    Eight twist;              ///< of the mean turn, about the normal

    /// Takes up to eight contacts. In large strain it turns the planes of those that are joints between rigid blocks with the blocks
    /// whose faces are on them, and moves their origins with the mean of the blocks. What the lanes of others hold means nothing.
    void take(Model& model, std::span<const Row> contacts);
};

/// Whether a contact moves as a joint between rigid blocks does.
bool is_rigid_joint(const Model& model, Row contact);

} // namespace kaya
