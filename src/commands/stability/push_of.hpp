// Makes what a line of solve control wants to push.
#pragma once

#include "commands/session/session.hpp"
#include "commands/stability/push.hpp"
#include "lang/commands/commands.hpp"

#include <memory>

namespace kaya {

/// Throws Diagnostic when there is nothing to push. Masses and forces must be known: Cycle::prepare.
std::unique_ptr<Push> push_of(Session& session, const lang::SolveControl& command);

} // namespace kaya
