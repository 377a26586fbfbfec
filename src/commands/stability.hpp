// Block theory over a model: docs/theory/slopes.md.
#pragma once

#include "laws/joint_model.hpp"
#include "model/model.hpp"
#include "slopes/sliding.hpp"

#include <vector>

namespace kaya {

/// A rigid body, or a block with zones taken as rigid.
struct BodyStability {
    std::vector<Row> blocks;
    bool fixed = false; ///< a velocity is prescribed on it
    double volume = 0;
    SlidingAnswer answer;
    int stage = 0; ///< 0: its neighbours hold it; else the round in which it becomes free
};

/// All bodies by their first blocks. Body by body against those that stay; when some have left (factor below 1), those after them again.
/// Throws Diagnostic when a block has no density.
std::vector<BodyStability> stability_of(Model& model, JointRegistry& laws);

} // namespace kaya
