// The stiffness of a joint model, and whether it is as soft as it reports.
#pragma once

#include "laws/joint_model.hpp"

#include <optional>
#include <vector>

namespace kaya {

/// How one sub-contact of area 1 answers a small step.
struct StiffnessTrial {
    const char* resists; ///< "closing" or "shear"
    double found;        ///< increase of the force per displacement
    double reported;     ///< the largest of the reported stiffnesses before and after it, which the time step uses
};

/// Closes and shears a sub-contact in turn by increasing steps and returns the worst of them; nullopt when the model fails in the first.
/// Throws Diagnostic (Fault::run) when it writes outside of its columns. A later failure ends the trial: the run reports it, with its
/// place.
std::optional<StiffnessTrial> try_stiffness(const JointModel& model, const std::vector<double>& values);

/// The tangent stiffnesses that a sub-contact of a joint model starts with, stress/length.
struct JointStiffness {
    double normal, shear;
};

/// Throws Diagnostic (Fault::run) when the model throws, or returns a stiffness that is not finite or negative, or a normal stiffness of 0.
/// Also when it returns less than half of the stiffness measured in closing and shear up to a moderate load.
JointStiffness initial_stiffness(const JointModel& model, const std::vector<double>& values);

} // namespace kaya
