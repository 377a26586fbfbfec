// solve fos: how much weaker the joints may become.
#pragma once

#include "commands/run/run_cycles.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

/// Finds the factor by which the strength of all joints can be divided before the model fails, always from the present state, and prints
/// its bracket. The model is left unchanged except for Clock::factor_of_safety. Throws Diagnostic when no joint has a strength, and when
/// the bracket of the command does not hold the factor. The ratio of the limits defines equilibrium, their cycles the length of one
/// trial.
void find_factor_of_safety(Session& session, const lang::Solve& command, const Limits& limits);

} // namespace kaya
