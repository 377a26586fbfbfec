// solve fos: how much weaker the joints may become.
#pragma once

#include "commands/run_cycles.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// Finds the factor by which the strength of all joints can be divided before the model fails, from the present state
/// each time, and says its bracket. The model is then as it was, but for Clock::factor_of_safety. Throws Diagnostic
/// when no joint has a strength, and when the bracket of the command does not hold the factor. Of the limits the
/// average ratio says what equilibrium is, and cycles how many one trial may take.
void find_factor_of_safety(Session& session, const lang::Solve& command, const Limits& limits);

} // namespace kaya
