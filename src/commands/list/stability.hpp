// Block theory over a model: docs/theory/slopes.md.
#pragma once

#include "laws/joint_model.hpp"
#include "model/tables/model.hpp"
#include "slopes/sliding.hpp"

#include <vector>

namespace kaya {

/// A rigid body; a zoned block counts as rigid.
struct BodyStability {
    std::vector<Row> blocks;
    bool fixed = false; ///< velocities are prescribed on it in three directions
    double volume = 0;
    SlidingAnswer answer;
    int stage = 0; ///< 0: its neighbours hold it; else the round that has this answer
};

/// All bodies by their first blocks. Each body against those that stay; when some have been removed (factor below 1), the remaining ones
/// again. Throws Diagnostic when a block has no density.
std::vector<BodyStability> stability_of(Model& model, JointRegistry& laws);

} // namespace kaya
