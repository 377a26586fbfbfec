// solve control: loads are scaled in every cycle such that their bodies move at a given speed, through the peak and past it.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// Runs until the displacement is reached, the load has fallen or a body has gone. Throws Diagnostic when there is nothing to scale. The last
/// load stays. docs/push-over.md
void push_over(Session& session, const lang::SolveControl& command);

} // namespace kaya
