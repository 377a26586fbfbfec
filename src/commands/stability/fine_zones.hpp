// The factor of safety on fine zones, from two factors of one mesh: docs/theory/slopes.md, "Shared strains".
#pragma once

#include "base/diagnostic.hpp"
#include "commands/session/session.hpp"
#include "commands/stability/failure_mode.hpp"
#include "commands/stability/strength_reduction.hpp"

#include <optional>

namespace kaya {

/// A factor of safety and how far that of fine zones may lie from it.
struct FineFactor {
    double factor, error;
};

/// Whether `solve fos` searches the factor on fine zones: by itself where all zones that flow are Mohr-Coulomb ones that dilate as much as
/// they have friction, as in the slopes that the estimate was fitted to. Throws Diagnostic where the command asks for it and the model has
/// none: without zones that flow, with joints, or with structures.
FineZones fine_zones(Session& session, const Asked& asked, const lang::Solve& command);

/// From the factors of the zones as they are, and of those that share their strains. Both are known within half of `resolution`, a part of
/// them. None where too few zones failed to say, or where sharing makes the zones stronger.
std::optional<FineFactor> fine_factor(double own, double shared, const FailureMode::Shares& mode, double resolution);

} // namespace kaya
