#include "commands/handlers.hpp"

#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

/// What becomes of a command that a script gives inside a cycle (command ... endcommand in a
/// whilestepping function).
enum class InCycle {
    runs,   ///< reads, or writes what may be written at any time
    waits,  ///< changes the structure: runs at the end of the cycle
    refused ///< would cycle inside a cycle, or take away the model that is cycling
};

template <class Command> void add(Session& session, lang::Handlers& handlers, InCycle in_cycle) {
    handlers.on<Command>([&session, in_cycle](const Command& command) {
        if (!session.inside_cycle || in_cycle == InCycle::runs) return run(session, command);
        if (in_cycle == InCycle::refused)
            throw Diagnostic("this command cannot be used by a function that runs inside a cycle", {},
                             Fault::run);
        session.deferred.emplace_back(session.interpreter.current_place(),
                                      [&session, command] { run(session, command); });
    });
}

} // namespace

void register_handlers(Session& session, lang::Handlers& handlers) {
    add<lang::New>(session, handlers, InCycle::refused);
    add<lang::Config>(session, handlers, InCycle::waits);
    add<lang::Title>(session, handlers, InCycle::runs);
    add<lang::Save>(session, handlers, InCycle::waits);
    add<lang::Restore>(session, handlers, InCycle::refused);
    add<lang::Pause>(session, handlers, InCycle::runs);
    add<lang::Set>(session, handlers, InCycle::waits);
    add<lang::Parameter>(session, handlers, InCycle::waits);
    add<lang::NameRange>(session, handlers, InCycle::runs);

    add<lang::PolyBrick>(session, handlers, InCycle::waits);
    add<lang::PolyPrism>(session, handlers, InCycle::waits);
    add<lang::PolyFace>(session, handlers, InCycle::waits);
    add<lang::PolyTet>(session, handlers, InCycle::waits);
    add<lang::PolyCube>(session, handlers, InCycle::waits);
    add<lang::PolyDrum>(session, handlers, InCycle::waits);
    add<lang::PolyTunnel>(session, handlers, InCycle::waits);
    add<lang::JointSetCommand>(session, handlers, InCycle::waits);
    add<lang::Import>(session, handlers, InCycle::waits);
    add<lang::Export>(session, handlers, InCycle::waits);
    add<lang::TunnelCommand>(session, handlers, InCycle::waits);
    add<lang::CutGround>(session, handlers, InCycle::waits);
    add<lang::Densify>(session, handlers, InCycle::waits);
    add<lang::Mark>(session, handlers, InCycle::runs);
    add<lang::MarkJoint>(session, handlers, InCycle::waits);
    add<lang::Join>(session, handlers, InCycle::waits);
    add<lang::JoinContact>(session, handlers, InCycle::waits);
    add<lang::Hide>(session, handlers, InCycle::runs);
    add<lang::Seek>(session, handlers, InCycle::runs);
    add<lang::Delete>(session, handlers, InCycle::waits);
    add<lang::Excavate>(session, handlers, InCycle::waits);
    add<lang::Fill>(session, handlers, InCycle::waits);
    add<lang::Copy>(session, handlers, InCycle::waits);
    add<lang::Group>(session, handlers, InCycle::runs);
    add<lang::FaceTriangulation>(session, handlers, InCycle::waits);
    add<lang::GenerateEdge>(session, handlers, InCycle::waits);
    add<lang::GenerateQuad>(session, handlers, InCycle::waits);

    add<lang::Property>(session, handlers, InCycle::waits);
    add<lang::Change>(session, handlers, InCycle::waits);
    add<lang::JointModelCommand>(session, handlers, InCycle::waits);
    add<lang::JointModelTest>(session, handlers, InCycle::waits);
    add<lang::ZoneModelCommand>(session, handlers, InCycle::waits);
    add<lang::ZoneAveraging>(session, handlers, InCycle::waits);

    add<lang::Fix>(session, handlers, InCycle::waits);
    add<lang::Free>(session, handlers, InCycle::waits);
    add<lang::Gravity>(session, handlers, InCycle::runs);
    add<lang::Boundary>(session, handlers, InCycle::waits);
    add<lang::Apply>(session, handlers, InCycle::waits);
    add<lang::Initialize>(session, handlers, InCycle::runs);
    add<lang::InSitu>(session, handlers, InCycle::waits);
    add<lang::Reset>(session, handlers, InCycle::waits);

    add<lang::TableCommand>(session, handlers, InCycle::runs);
    add<lang::WaterCommand>(session, handlers, InCycle::waits);
    add<lang::LimitEquilibrium>(session, handlers, InCycle::refused);
    add<lang::StructureCable>(session, handlers, InCycle::waits);
    add<lang::StructureProperty>(session, handlers, InCycle::waits);
    add<lang::StructureDelete>(session, handlers, InCycle::waits);

    add<lang::HistoryAdd>(session, handlers, InCycle::waits);
    add<lang::HistoryLabel>(session, handlers, InCycle::runs);
    add<lang::HistoryDelete>(session, handlers, InCycle::waits);
    add<lang::HistoryWrite>(session, handlers, InCycle::runs);

    add<lang::VtkWrite>(session, handlers, InCycle::waits);
    add<lang::List>(session, handlers, InCycle::runs);
    add<lang::Plot>(session, handlers, InCycle::runs);
    add<lang::Movie>(session, handlers, InCycle::runs);
    add<lang::Ignored>(session, handlers, InCycle::runs);

    add<lang::CycleCommand>(session, handlers, InCycle::refused);
    add<lang::Solve>(session, handlers, InCycle::refused);
    add<lang::Damp>(session, handlers, InCycle::waits);
    add<lang::MassScale>(session, handlers, InCycle::waits);
    add<lang::Fraction>(session, handlers, InCycle::waits);

    add<lang::FishDefinition>(session, handlers, InCycle::runs);
    add<lang::FishCall>(session, handlers, InCycle::runs);
    add<lang::FishCallback>(session, handlers, InCycle::runs);
    add<lang::LuaChunk>(session, handlers, InCycle::runs);
    add<lang::LuaFile>(session, handlers, InCycle::runs);
}

} // namespace kaya
