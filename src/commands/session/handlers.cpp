#include "commands/session/handlers.hpp"

#include "commands/program/remedies.hpp"
#include "model/edit/bounded.hpp"

#include <utility>

namespace kaya {

namespace {

/// Commands that compute with shapes, or store the model: refused after a run has diverged.
using NeedBoundedModel = lang::CommandList<lang::Save, lang::VtkWrite, lang::PolyTunnel, lang::Import, lang::Export,
                                           lang::Excavate, lang::Fill, lang::Copy, lang::GenerateEdge,
                                           lang::GenerateQuad, lang::InSitu, lang::LimitEquilibrium,
                                           lang::StructureCable, lang::StructureBeam, lang::StructureLiner, lang::Plot>;

template <class... Command> bool is_one_of(std::size_t index, lang::CommandList<Command...>) {
    return ((lang::index_of<Command> == index) || ...);
}

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
        if (is_one_of(command.spec->index, NeedBoundedModel{}) || is_one_of(command.spec->index, lang::CutCommands{}))
            require_bounded(session.engine.model);
        handlers()[command.spec->index](session, command.command);
    } catch (const Advised& mistake) { throw worded(mistake, command.modern); }
}

void put_off(Session& session, std::function<void()> change) {
    const auto carry_out = [&session, change = std::move(change)] {
        require_bounded(session.engine.model); // the cycle has changed the model since
        change();
    };
    session.engine.deferred.emplace_back(session.deck.interpreter.current_place(), carry_out);
}

void refuse_in_cycle() {
    throw Diagnostic("this command cannot be used by a function that runs inside a cycle", {}, Fault::run);
}

} // namespace kaya
