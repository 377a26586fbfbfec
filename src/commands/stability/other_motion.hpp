// What must not act in a run whose speed and time mean nothing.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// Throws Diagnostic when the result of solve control would depend on its speed: no damping, velocities that it does not drive, loads that
/// change with time, quiet boundaries. Velocities must be those of the last cycle.
void refuse_other_motion(Session& session, const lang::SolveControl& command);

} // namespace kaya
