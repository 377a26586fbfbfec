// A look at whether a joint model is as soft as it says.
#pragma once

#include "laws/joint_model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// How one sub-contact of area 1 answers a small step.
struct StiffnessTrial {
    const char* resists; ///< "closing" or "shear"
    double found;        ///< growth of the force per way
    double reported;     ///< the largest of the stiffnesses before and after it: the time step knows no more
};

/// Closes and shears a sub-contact in turn by ever larger steps and gives the worst of them; nullopt when the model fails
/// at once. Throws Diagnostic (Fault::run) when it writes where it must not. A later failure ends the trial: it is found again, with its place, when the model runs.
std::optional<StiffnessTrial> try_stiffness(const JointModel& model, const std::vector<double>& values);

} // namespace kaya
