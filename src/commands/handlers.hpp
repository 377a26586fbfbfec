// What each command does: one function for one struct of lang/commands/commands.hpp.
// The functions stand in one file per family; all of them throw Diagnostic for a user's mistake and
// leave the model as it was then.
#pragma once

#include "commands/session.hpp"
#include "lang/commands/commands.hpp"

namespace kaya {

// control.cpp
void run(Session&, const lang::New&);
void run(Session&, const lang::Config&);
void run(Session&, const lang::Title&);
void run(Session&, const lang::Pause&);
void run(Session&, const lang::Set&);
void run(Session&, const lang::Parameter&);
void run(Session&, const lang::NameRange&);

// shapes.cpp
/// Warns, the first time in a model, when one of the blocks from `first` on stands where another is.
void warn_of_overlaps(Session& session, Row first, const Place& place);
void run(Session&, const lang::PolyBrick&);
void run(Session&, const lang::PolyPrism&);
void run(Session&, const lang::PolyFace&);
void run(Session&, const lang::PolyTet&);
void run(Session&, const lang::PolyCube&);
void run(Session&, const lang::PolyDrum&);
void run(Session&, const lang::PolyTunnel&);

// exchange.cpp
void run(Session&, const lang::Import&);
void run(Session&, const lang::Export&);

// cuts.cpp
void run(Session&, const lang::JointSetCommand&);
void run(Session&, const lang::TunnelCommand&);
void run(Session&, const lang::CutGround&);
void run(Session&, const lang::Densify&);
void run(Session&, const lang::Join&);
void run(Session&, const lang::JoinContact&);

// geometry.cpp
void run(Session&, const lang::Hide&);
void run(Session&, const lang::Seek&);
void run(Session&, const lang::Delete&);
void run(Session&, const lang::FaceTriangulation&);
void run(Session&, const lang::GenerateEdge&);
void run(Session&, const lang::GenerateQuad&);

// selection.cpp
void run(Session&, const lang::Group&);
void run(Session&, const lang::Mark&);
void run(Session&, const lang::MarkJoint&);
void run(Session&, const lang::Excavate&);
void run(Session&, const lang::Fill&);
void run(Session&, const lang::Copy&);

// materials.cpp
void run(Session&, const lang::Property&);
void run(Session&, const lang::Change&);
void run(Session&, const lang::JointModelCommand&);

// zone_models.cpp
void run(Session&, const lang::ZoneModelCommand&);
void run(Session&, const lang::ZoneAveraging&);
void run(Session&, const lang::JointModelTest&);

// boundary.cpp
void run(Session&, const lang::Fix&);
void run(Session&, const lang::Free&);
void run(Session&, const lang::Gravity&);
void run(Session&, const lang::Boundary&);
void run(Session&, const lang::Apply&);
void run(Session&, const lang::Initialize&);
void run(Session&, const lang::InSitu&);
void run(Session&, const lang::Reset&);

// tables.cpp
void run(Session&, const lang::TableCommand&);

// water.cpp
void run(Session&, const lang::WaterCommand&);
void run(Session&, const lang::LimitEquilibrium&);

// structures.cpp
void run(Session&, const lang::StructureCable&);
void run(Session&, const lang::StructureProperty&);
void run(Session&, const lang::StructureDelete&);

// histories.cpp
void run(Session&, const lang::HistoryAdd&);
void run(Session&, const lang::HistoryLabel&);
void run(Session&, const lang::HistoryDelete&);

// listing.cpp
void run(Session&, const lang::List&);

// files.cpp
void run(Session&, const lang::Save&);
void run(Session&, const lang::Restore&);
void run(Session&, const lang::HistoryWrite&);
void run(Session&, const lang::VtkWrite&);
void run(Session&, const lang::Ignored&);

// plot.cpp
void run(Session&, const lang::Plot&);
void run(Session&, const lang::Movie&);

// solution.cpp
void run(Session&, const lang::CycleCommand&);
void run(Session&, const lang::Solve&);
void run(Session&, const lang::Damp&);
void run(Session&, const lang::MassScale&);
void run(Session&, const lang::Fraction&);

// scripts.cpp
void run(Session&, const lang::FishDefinition&);
void run(Session&, const lang::FishCall&);
void run(Session&, const lang::FishCallback&);
void run(Session&, const lang::LuaChunk&);
void run(Session&, const lang::LuaFile&);

/// Tells the interpreter which function runs which command: the explicit list.
void register_handlers(Session& session, lang::Handlers& handlers);

} // namespace kaya
