// Handlers of commands: a function run(Session&, const COMMAND&) for each struct of lang/commands/commands.hpp, in one file per list of
// commands; all throw Diagnostic for a user's error and leave the model unchanged then.
#pragma once

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"

#include <any>
#include <array>
#include <functional>

namespace kaya {

using Handler = void (*)(Session&, const std::any& command);
/// By index_of the command; null for those that the interpreter runs itself.
using HandlerTable = std::array<Handler, lang::Commands::size>;

/// Runs a command of a deck.
void run_command(Session& session, const lang::BoundCommand& command);

/// Defers a change until the end of the cycle.
void put_off(Session& session, std::function<void()> change);
/// Throws Diagnostic: the command cannot be used inside a cycle.
[[noreturn]] void refuse_in_cycle();

template <class Command> void handle(Session& session, const std::any& boxed) {
    const auto& command = std::any_cast<const Command&>(boxed);
    if (lang::is_in<Command>(lang::RunInCycle{}) || !session.engine.inside_cycle) return run(session, command);
    if (lang::is_in<Command>(lang::RefusedInCycle{})) refuse_in_cycle();
    put_off(session, [&session, command] { run(session, command); });
}

/// Puts the functions of a list into the table: at the end of the file that has them, so that one that is missing does not
/// compile.
template <class... Command> void fill(HandlerTable& table, lang::CommandList<Command...>) {
    ((table[lang::index_of<Command>] = handle<Command>), ...);
}

void add_handlers(HandlerTable& table, lang::ControlCommands list);         // control.cpp
void add_handlers(HandlerTable& table, lang::FileCommands list);            // files.cpp
void add_handlers(HandlerTable& table, lang::ShapeCommands list);           // shapes.cpp
void add_handlers(HandlerTable& table, lang::CutCommands list);             // cuts.cpp
void add_handlers(HandlerTable& table, lang::SurfaceCommands list);         // surfaces.cpp
void add_handlers(HandlerTable& table, lang::FractureCommands list);        // fractures.cpp
void add_handlers(HandlerTable& table, lang::FractureChangeCommands list);  // fracture_changes.cpp
void add_handlers(HandlerTable& table, lang::FractureMeasureCommands list); // fracture_measures.cpp
void add_handlers(HandlerTable& table, lang::ExchangeCommands list);        // exchange.cpp
void add_handlers(HandlerTable& table, lang::SelectionCommands list);       // selection.cpp
void add_handlers(HandlerTable& table, lang::GeometryCommands list);        // geometry.cpp
void add_handlers(HandlerTable& table, lang::MaterialCommands list);        // materials.cpp
void add_handlers(HandlerTable& table, lang::ZoneModelCommands list);       // zone_models.cpp
void add_handlers(HandlerTable& table, lang::DensityCommands list);         // densities.cpp
void add_handlers(HandlerTable& table, lang::NewContactCommands list);      // new_contacts.cpp
void add_handlers(HandlerTable& table, lang::BoundaryCommands list);        // boundary.cpp
void add_handlers(HandlerTable& table, lang::InitialStateCommands list);    // initial_state.cpp
void add_handlers(HandlerTable& table, lang::TableCommands list);           // tables.cpp
void add_handlers(HandlerTable& table, lang::WaterCommands list);           // water.cpp
void add_handlers(HandlerTable& table, lang::SlopeCommands list);           // limit_equilibrium.cpp
void add_handlers(HandlerTable& table, lang::StructureCommands list);       // structures.cpp
void add_handlers(HandlerTable& table, lang::HistoryCommands list);         // histories.cpp
void add_handlers(HandlerTable& table, lang::ListCommands list);            // listing.cpp
void add_handlers(HandlerTable& table, lang::PlotCommands list);            // plot.cpp
void add_handlers(HandlerTable& table, lang::MovieCommands list);           // movie.cpp
void add_handlers(HandlerTable& table, lang::SolutionCommands list);        // solution.cpp
void add_handlers(HandlerTable& table, lang::ScriptCommands list);          // scripts.cpp

} // namespace kaya
