#include "commands/handlers.hpp"

#include "commands/remedies.hpp"

#include <utility>

namespace kaya {

namespace {

template <class... List> HandlerTable all_handlers(lang::CommandLists<List...>) {
    HandlerTable table{};
    (add_handlers(table, List{}), ...);
    return table;
}

const HandlerTable& handlers() {
    static const HandlerTable table = all_handlers(lang::HandledCommands{});
    return table;
}

} // namespace

void run_command(Session& session, const lang::BoundCommand& command) {
    try {
        handlers()[command.spec->index](session, command.command);
    } catch (const Advised& mistake) { throw worded(mistake); }
}

void put_off(Session& session, std::function<void()> change) {
    session.deferred.emplace_back(session.interpreter.current_place(), std::move(change));
}

void refuse_in_cycle() {
    throw Diagnostic("this command cannot be used by a function that runs inside a cycle", {}, Fault::run);
}

} // namespace kaya
