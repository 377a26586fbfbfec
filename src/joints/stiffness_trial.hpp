// A look at whether a joint model is as soft as it says.
#pragma once

#include "joints/joint_model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// How one sub-contact of area 1 answers a small closing.
struct StiffnessTrial {
    double found;    ///< normal force per closing
    double reported; ///< the larger of the normal stiffnesses before and after it
};

/// Closes a sub-contact by a few small steps and gives the worst of them; nullopt when the model fails or gives
/// no number, which is found again, with its place, when it runs.
std::optional<StiffnessTrial> try_stiffness(const JointModel& model, const std::vector<double>& values);

} // namespace kaya
