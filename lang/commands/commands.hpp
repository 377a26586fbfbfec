// Every command as a struct of typed arguments, which the tables fill and the handlers receive. The tables next to this header map words
// and numbers to members; the lists at the end assign the structs to handlers.
#pragma once

#include "base/object_kind.hpp"
#include "lang/commands/command_list.hpp"
#include "lang/commands/condition_commands.hpp"
#include "lang/commands/model_commands.hpp"
#include "lang/commands/range.hpp"
#include "lang/interp/value.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace kaya::lang {

// --- solution ---------------------------------------------------------------------------------------
struct CycleCommand {
    std::optional<std::int64_t> cycles;
    std::optional<double> time;
    std::int64_t calm = 0; ///< all motion is stopped each time after so many cycles; 0: never
};
struct Solve {
    std::optional<double> ratio, maximum_ratio, local_ratio; ///< ratio: the average one
    std::optional<double> force, time, clock;                ///< clock in minutes
    std::optional<std::int64_t> cycles;
    std::optional<std::int64_t> total_cycles; ///< of the model, not of this run
    std::optional<double> total_time;
    bool all = false; ///< `and`: the run ends when all limits are reached, not at the first
    bool elastic = false;
    bool only = false;     ///< of elastic: without the true joints
    std::int64_t calm = 0; ///< see CycleCommand::calm
    bool factor_of_safety = false;
    bool still = false; ///< accept a ratio or a force only when no body gains displacement any more
    std::optional<std::array<double, 2>> bracket; ///< of the factor: a stable value and a failing value
    double resolution = 0.005;                    ///< of the factor, as a part of it
    std::string file;                             ///< where the failing state is saved
    enum class Reduced {
        joints,
        zones,
        friction,
        cohesion,
        tension,
        joint_friction,
        joint_cohesion,
        joint_tension,
        zone_friction,
        zone_cohesion,
        zone_tension
    };
    std::vector<Reduced> included, excluded; ///< of fos: the properties that are reduced; none included: all
    bool keep = false;                       ///< of fos: keep the failed state of the model
    bool associated = false;                 ///< of fos: zones dilate as much as they have friction
    std::optional<bool>
        extrapolate; ///< of fos: whether to estimate the factor of fine zones; none: for the zones that it was fitted to
    Place place;
};
/// solve control: loads are scaled such that their bodies move at a given speed, or a boundary is driven.
struct SolveControl {
    std::optional<Vec3> gravity;      ///< direction in which gravity is scaled
    std::string variable;             ///< of FISH: scales the loads, or the velocities, with `hist @variable`
    std::optional<Vec3> point, along; ///< of the displacement that counts; none: that of the loads or the boundary
    double speed = 0, to = 0;         ///< of that displacement, above 0
    double damped = 0.02;             ///< share of the work above which the run goes slower
    double below = 0;                 ///< share of the peak at which the run ends
    std::int64_t every = 50;          ///< cycles of a row of the curve
    std::string file;                 ///< of the curve
    std::string picture, reactions,
        energies;                      ///< files of pictures over the displacement: of the load, and of the others
    std::optional<std::int64_t> table; ///< number of the table that gets the load over the displacement
    Place place;
};
/// limit equilibrium
struct LimitEquilibrium {
    enum class Method { ordinary, bishop, janbu, spencer, morgenstern_price };
    enum class Surfaces { circles, polylines };
    std::vector<Method> methods;                ///< none: the usual ones
    std::optional<Vec3> origin, direction;      ///< of the section
    std::optional<Vec3> circle;                 ///< distance, height, radius
    std::vector<std::array<double, 2>> surface; ///< distance, height
    Surfaces search = Surfaces::circles;        ///< when no surface is given
    std::optional<std::array<double, 2>> entry, exit;
    std::int64_t slices = 50, corners = 8;
    double crack = 0, crack_water = 0, seismic = 0, pressure_ratio = 0, least_depth = 0;
    std::optional<std::int64_t> water_table; ///< number of a table: height of the water over distance
    std::optional<std::int64_t> table;       ///< number of a table that gets the surface
    std::string file;                        ///< of a picture of the section
    Place place;
};
/// structure cable: a bolt or tendon
struct StructureCable {
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    std::int64_t segments = 10, property = 1;
    double tension = 0;
    bool anchor_first = false, anchor_last = false;
    Place place;
};
/// structure beam: a line of bars that bend, through these places
struct StructureBeam {
    std::vector<Vec3> places;
    std::int64_t segments = 10, property = 1;
    std::optional<Vec3> axis;
    double tolerance = 0;
    enum class Grip { link, anchor, clamp };
    Grip all = Grip::link, first = Grip::link, last = Grip::link;
    Place place;
};
/// structure liner: plates on the faces in a range
struct StructureLiner {
    std::int64_t property = 1;
    std::optional<Vec3> axis;
    double edge = 0, tolerance = 0;
    StructureBeam::Grip grip = StructureBeam::Grip::link;
    RangePhrase range;
    Place place;
};
/// structure property: properties of cables, beams and liners
struct StructureProperty {
    struct Item {
        std::string name;
        double value = 0;
    };
    std::int64_t number = 1;
    std::vector<Item> items;
    Place place;
};
struct StructureDelete {
    std::optional<std::int64_t> number;
    RangePhrase range;
};
struct Damp {
    enum class Kind { none, local, global, combined, rayleigh };
    std::optional<Kind> kind;           ///< not given: unchanged
    std::optional<double> value;        ///< local 0.8
    double fraction = 0, frequency = 0; ///< rayleigh
    bool mass = true, stiffness = true;
    std::optional<double> contact; ///< dashpots of contacts, of critical damping
};
/// One of three: all masses, none, or those that the time step needs.
struct MassScale {
    bool on = false, off = false;
    std::optional<double> step;
};
struct Fraction {
    double value = 0;
};

// --- scripts -----------------------------------------------------------------------------------------
/// def NAME ... end: all its lines, the first and the last included; place is that of the first line.
struct FishDefinition {
    std::string text;
    Place place;
};
/// fish callback add NAME [place in the cycle | event e] [interval n], fish callback remove NAME; set fishcall n NAME.
struct FishCallback {
    enum class When { before_cycle, after_forces, after_cycle, solve_start, solve_complete };
    std::string function;
    bool remove = false;
    std::optional<When> when;       ///< none, to be removed: wherever it runs
    std::optional<double> location; ///< within a cycle: orders the calls of one `when`
    std::int64_t interval = 1;
    Place place;
};
/// fish automatic-create on|off, fish structure NAME(a, b)
struct FishSetting {
    std::optional<bool> automatic_create; ///< variables exist from their first mention on
    std::string structure;                ///< the name of a kind of structure, and those of its members
    std::vector<std::string> members;
    Place place;
};
/// param name = value: the first value of a name is kept; kaya --set gives it before the deck does.
struct Parameter {
    std::string name;
    Value value;
    Place place;
};
/// a line @f(1) or [f(1)]: without @ and brackets
struct FishCall {
    std::string expression;
    Place place;
    std::vector<std::pair<std::string, Place>>
        further; ///< of a bracket over several lines, or after the first on the line
};
struct LuaChunk {
    std::string text;
    Place place;
}; ///< the lines between lua and endlua; place of the first
struct LuaFile {
    std::string file;
    Place place;
};

// --- all commands ---------------------------------------------------------------------------------------
struct NotSupportedYet {}; ///< known by name, and refused when the deck is read

/// Commands without a handler.
using OwnCommands = CommandList<CallFile, Return, Quit, NotSupportedYet>;

// Grouped by the file of src/commands that runs them. A command that is missing in all lists does not compile in the file of its words. A
// command that is listed without a handler does not compile in the file of the handlers.
using ControlCommands = CommandList<New, Config, Title, Pause, ReadDialect, Set, NameRange>;
using FileCommands = CommandList<Save, Restore, HistoryWrite, VtkWrite, Ignored>;
using ShapeCommands = CommandList<PolyBrick, PolyPrism, PolyFace, PolyTet, PolyCube, PolyDrum, PolyTunnel>;
using CutCommands = CommandList<JointSetCommand, TunnelCommand, CutGround, CutSurface, CutPolygons, CutFractures,
                                Densify, Join, JoinContact>;
using SurfaceCommands = CommandList<GeometryCommand>;
using FractureCommands =
    CommandList<FractureCommand, FractureTemplate, FractureGenerate, FractureImport, FractureExport>;
using FractureChangeCommands = CommandList<FractureChange>;
using FractureMeasureCommands = CommandList<FractureMeasure>;
using ExchangeCommands = CommandList<Import, Export>;
using SelectionCommands = CommandList<Group, Mark, MarkJoint, Excavate, Fill, Copy>;
using GeometryCommands = CommandList<Hide, Seek, Delete, FaceTriangulation, GenerateEdge, GenerateQuad>;
using MaterialCommands = CommandList<Property, Change, JointModelCommand, JointModelTest>;
using ZoneModelCommands = CommandList<ZoneModelCommand, ZoneAveraging>;
using DensityCommands = CommandList<BlockDensity>;
using NewContactCommands = CommandList<NewContacts, JointRuleCommand, FindContacts>;
using BoundaryCommands = CommandList<Fix, Free, Gravity, Boundary, Apply, Reset>;
using InitialStateCommands = CommandList<Initialize, InSitu>;
using TableCommands = CommandList<TableCommand>;
using WaterCommands = CommandList<WaterCommand>;
using SlopeCommands = CommandList<LimitEquilibrium>;
using StructureCommands =
    CommandList<StructureCable, StructureBeam, StructureLiner, StructureProperty, StructureDelete>;
using HistoryCommands = CommandList<HistoryAdd, HistoryLabel, HistoryDelete>;
using ListCommands = CommandList<List>;
using PlotCommands = CommandList<Plot>;
using MovieCommands = CommandList<Movie>;
using SolutionCommands = CommandList<CycleCommand, Solve, SolveControl, Damp, MassScale, Fraction>;
using ScriptCommands = CommandList<FishDefinition, FishCall, FishCallback, FishSetting, LuaChunk, LuaFile, Parameter>;

using HandledCommands =
    CommandLists<ControlCommands, FileCommands, ShapeCommands, CutCommands, SurfaceCommands, FractureCommands,
                 FractureChangeCommands, FractureMeasureCommands, ExchangeCommands, SelectionCommands, GeometryCommands,
                 MaterialCommands, ZoneModelCommands, DensityCommands, NewContactCommands, BoundaryCommands,
                 InitialStateCommands, TableCommands, WaterCommands, SlopeCommands, StructureCommands, HistoryCommands,
                 ListCommands, PlotCommands, MovieCommands, SolutionCommands, ScriptCommands>;
using Commands = JoinedLists<OwnCommands, HandledCommands>::All;

template <class Command> inline constexpr std::size_t index_of = index_in<Command>(Commands{});

/// Commands that a script may give inside a cycle: those that read, those that write values that may change at any time, and those that
/// would cycle or replace the running model (they are refused). All others change the structure and wait for the end of the cycle.
using RunInCycle = CommandList<Title, Pause, ReadDialect, NameRange, Mark, Hide, Seek, Group, Gravity, Initialize,
                               TableCommand, HistoryLabel, HistoryWrite, List, Plot, Movie, Ignored, FishDefinition,
                               FishCall, FishCallback, FishSetting, LuaChunk, LuaFile>;
using RefusedInCycle = CommandList<New, Restore, LimitEquilibrium, CycleCommand, Solve>;

} // namespace kaya::lang
