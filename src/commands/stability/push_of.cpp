#include "commands/stability/push_of.hpp"

#include "base/diagnostic.hpp"
#include "commands/conditions/tables.hpp"
#include "commands/stability/moved_boundary.hpp"
#include "commands/stability/pushed_load.hpp"
#include "commands/stability/scaled_histories.hpp"

#include <fmt/format.h>

namespace kaya {

std::unique_ptr<Push> push_of(Session& session, const lang::SolveControl& command) {
    if (command.variable.empty()) return std::make_unique<PushedLoad>(session, command);
    check_symbol(session, command.variable);
    if (!scaled_histories(session.engine.model, command.variable).are_velocities)
        return std::make_unique<PushedLoad>(session, command);
    if (command.gravity)
        throw Diagnostic(fmt::format("gravity is a load, and '@{}' drives a boundary", command.variable),
                         "one factor cannot scale both: leave out one of them")
            .at(command.place);
    return std::make_unique<MovedBoundary>(session, command);
}

} // namespace kaya
