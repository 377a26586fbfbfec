// Every command as a struct of typed arguments: what the tables fill and the handlers take.
// The tables next to this header say which words and numbers go into which member; the lists at the end say who runs them.
#pragma once

#include "base/object_kind.hpp"
#include "lang/commands/command_list.hpp"
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

// --- model control ------------------------------------------------------------------------------
struct New {};
struct Config { bool dynamic = false; };
struct CallFile { std::string file; };
struct Return {};
struct Quit {};
struct Title { std::string text; };
struct Save { std::string file; };
struct Restore { std::string file; };
struct Pause {};

/// One `set` line may hold several settings; those not given stay as they are.
struct Set {
    std::optional<bool> dynamic;             ///< dyn on|off
    std::optional<bool> small;               ///< small on|off
    std::optional<bool> log;                 ///< log on|off
    std::optional<std::string> log_file;     ///< logfile f
    std::optional<std::int64_t> default_joint_constitutive; ///< jcondf
    std::optional<std::int64_t> default_joint_material;     ///< jmatdf
    std::optional<double> time_step_fraction; ///< fraction
    std::optional<double> time_step;          ///< dt; 0: computed
    std::optional<std::int64_t> threads;
    std::optional<double> autosave; ///< minutes; 0: none
    std::optional<bool> echo;
    std::optional<bool> report; ///< report on|off
    std::optional<Vec3> gravity;
    std::optional<std::int64_t> seed; ///< random n: of urand and grand
    std::vector<std::pair<std::string, Value>> fish; ///< set @name = value; the name is without @
};

// --- geometry -----------------------------------------------------------------------------------
struct BlockOptions { std::int64_t region = 0, material = 1, constitutive = 1; };
struct PolyBrick {
    std::array<double, 2> x{}, y{}, z{}; ///< y and z are the x limits when they are left out
    BlockOptions options;
    Place place;
};
struct PolyPrism {
    std::vector<Vec3> first, second; ///< corners of the two polygons, each opposite its partner
    BlockOptions options;
    Place place;
};
struct PolyFace {
    struct Face {
        std::vector<Vec3> corners;
        std::int64_t joint_set = 0; ///< face id k
    };
    std::vector<Face> faces;
    BlockOptions options;
    Place place;
};
struct PolyTet { std::vector<Vec3> corners; BlockOptions options; Place place; };
struct PolyCube {
    Vec3 centre = Vec3::Zero();
    double edge = 0;
    BlockOptions options;
    Place place;
};
struct PolyDrum {
    std::optional<Vec3> end1, end2;
    std::optional<double> radius1, radius2; ///< radius2 is radius1 when it is left out
    std::int64_t sides = 8;
    BlockOptions options;
    Place place;
};
struct PolyTunnel {
    double dip = 0, dip_direction = 0; ///< of the axis
    Vec3 origin = Vec3::Zero();
    double radius = 1, boundary = 4, ratio = 1;
    std::array<double, 2> length{-10, 10}; ///< begin and end along the axis
    std::int64_t radial = 1, tangential = 1, axial = 1;
    bool core = true;
    std::optional<std::int64_t> core_region; ///< that of the rings if not given
    std::string core_group;
    BlockOptions options;
    Place place;
};
/// One family of parallel joints; angles in degrees, deviations are half widths of the scatter.
struct JointSetCommand {
    std::array<double, 2> dip{}, dip_direction{}, spacing{}; ///< value and deviation
    std::int64_t number = 1;
    Vec3 origin = Vec3::Zero();
    double persistence = 1;
    std::optional<std::int64_t> id; ///< none: the next that is free
    std::int64_t seed = 0;
    bool join = false; ///< the pieces of a block stay one body
    RangePhrase range;
    Place place;
};
/// The outline of a tunnel: two polygons with matching corners.
struct TunnelCommand {
    std::vector<Vec3> first, second;
    std::int64_t region = 0; ///< of the blocks inside; 0: as they were
    bool radial = false;     ///< cuts the rock around through each corner, too
    RangePhrase range;
    Place place;
};
/// cut ground: along a ground surface.
struct CutGround {
    std::string file;
    Vec3 shift = Vec3::Zero();
    std::optional<std::int64_t> id; ///< of the faces that are cut
    std::optional<std::int64_t> region; ///< of the blocks below
    RangePhrase range;
    Place place;
};
/// Cuts each block into equal parts along x, y and z.
struct Densify {
    std::array<std::int64_t, 3> parts{1, 1, 1};
    bool join = false; ///< the parts stay one body
    RangePhrase range;
    Place place;
};
/// Blocks from a file: its suffix says the format.
struct Import { std::string file; BlockOptions options; Place place; };
struct Export { std::string file; RangePhrase range; Place place; };
struct Mark { std::int64_t region = 0; RangePhrase range; };
/// Gives faces, and the contacts on them, the number of a joint set.
struct MarkJoint { std::int64_t joint_set = 0; RangePhrase range; };
/// Joins blocks that touch into one body, or takes bodies apart.
struct Join { bool on = true; RangePhrase range; Place place; };
/// Joins the two blocks of each contact.
struct JoinContact { RangePhrase range; Place place; };
struct Hide { RangePhrase range; };
struct Seek { RangePhrase range; };
struct Delete { RangePhrase range; };
/// Takes blocks out and keeps them; fill puts them back.
struct Excavate { RangePhrase range; };
struct Fill { RangePhrase range; };
/// Copies of blocks: mirrored at a plane, then moved.
struct Copy {
    std::optional<Vec3> offset;
    bool mirror = false;
    double dip = 0, dip_direction = 0; ///< of the mirror
    std::optional<Vec3> normal;        ///< of the mirror, in place of dip and dip direction
    Vec3 origin = Vec3::Zero();        ///< a point of the mirror
    std::int64_t number = 1;
    std::optional<std::int64_t> region;
    std::string group;
    RangePhrase range;
    Place place;
};
struct Group {
    ObjectKind kind = ObjectKind::block; ///< contact: joints
    std::string name;
    RangePhrase range;
};
struct NameRange { std::string name; RangePhrase range; }; ///< range name NAME elements
/// facetri radial | rad8 | edge f | off: triangles of faces of rigid blocks, for their contacts
struct FaceTriangulation {
    enum class Style { fan, radial, radial_8, edge } style = Style::fan;
    double edge = 0;
    RangePhrase range;
    Place place;
};
struct GenerateEdge { double edge = 0; RangePhrase range; Place place; };
/// generate quad n1 n2 n3: blocks with eight corners are cut in cells along their own axes.
struct GenerateQuad {
    std::array<std::int64_t, 3> parts{1, 1, 1};
    std::array<double, 3> ratio{1, 1, 1}; ///< of each cell to the one before it
    bool given = false;                   ///< the line has said how many
    RangePhrase range;
    Place place;
};

// --- materials ----------------------------------------------------------------------------------
/// prop mat n | jmat n  word value ...: words are the classic ones (dens, bulk, k, g, ymod, jkn, ...)
/// and the properties of loaded joint models; those are known at run time only.
struct Property {
    bool joint = false; ///< `jmat` was typed
    std::int64_t number = 1;
    struct Item { std::string word; double value; Place place; bool is_switch = false; }; ///< a switch: `on` or `off` was typed
    std::vector<Item> items;
};
struct Change {
    std::optional<std::int64_t> material, constitutive, joint_material, joint_constitutive;
    RangePhrase range;
};
/// jmodel test NAME FILE [steps n] [area a] [word value ...]: one sub-contact, the model of the deck is not touched.
struct JointModelTest {
    std::string model;
    Place model_place;
    std::string path; ///< CSV file
    std::int64_t steps = 1000;
    double area = 1;
    std::vector<Property::Item> items;
};
/// jmodel load NAME | jmodel model NAME [word value ...] [range] | jmodel word value ... [range]
struct JointModelCommand {
    enum class Action { load, assign, properties } action = Action::properties;
    std::string model;
    Place model_place;
    std::vector<Property::Item> items;
    RangePhrase range;
};

/// zone load NAME | zone model NAME [word value ...] [range] | zone property word value ... [range]
struct ZoneModelCommand {
    enum class Action { load, assign, properties } action = Action::properties;
    std::string model;
    Place model_place;
    std::vector<Property::Item> items;
    RangePhrase range;
};
/// zone nmd on|off: mixed discretisation.
struct ZoneAveraging { bool on = true; };

// --- boundary and initial conditions --------------------------------------------------------------
/// Components x, y, z of translation and of rotation; none: all.
struct Fix {
    std::array<bool, 6> components{};
    std::vector<Vec3> directions; ///< of translation
    RangePhrase range;
};
struct Free {
    std::array<bool, 6> components{};
    bool directions = false;
    RangePhrase range;
};
/// A velocity, force or moment along a direction of any length.
struct Directed {
    double value = 0;
    Vec3 direction = Vec3::Zero();
};
struct Gravity { Vec3 value = Vec3::Zero(); };
/// hist sine f [t] | cosine f [t] | impulse f [t] | table n | @name: what a load or velocity is multiplied by.
struct Wave {
    enum class Form { sine, cosine, impulse } form = Form::sine;
    double frequency = 0, duration = 0; ///< duration 0: no end
};
struct TableValue { std::int64_t table = 0; };
struct ScriptValue { std::string symbol; }; ///< without @
struct Multiplier { std::variant<Wave, TableValue, ScriptValue> function; Place place; };
/// A number at the origin of coordinates and its change with x, y and z.
struct LinearNumber { double at_origin = 0; Vec3 gradient = Vec3::Zero(); };
struct Boundary {
    std::array<std::optional<double>, 6> velocity;  ///< xvel yvel zvel rxvel ryvel rzvel
    std::array<std::optional<double>, 3> load;      ///< xload yload zload, added
    std::array<bool, 6> free{};                     ///< xfree yfree zfree rxfree ryfree rzfree
    std::optional<std::array<double, 6>> stress;    ///< xx yy zz xy xz yz
    std::array<double, 6> x_gradient{}, y_gradient{}, z_gradient{};
    std::optional<Multiplier> multiplier;
    std::array<bool, 5> quiet{};                    ///< xviscous yviscous zviscous nviscous sviscous
    std::array<bool, 3> reaction{};                 ///< xreaction yreaction zreaction
    std::optional<double> normal_velocity;          ///< nvel
    std::vector<Directed> directed_velocity, directed_load; ///< dvel dload
    RangePhrase range;
    Place place;
};
struct Apply {
    std::array<std::optional<double>, 6> velocity; ///< of whole blocks
    std::array<std::optional<double>, 6> load;     ///< force through the centroid and moment, added
    std::vector<Directed> directed_velocity, directed_load, directed_moment; ///< dvel dload dmoment
    std::optional<Vec3> at;                        ///< where the forces act; the centroid if not given
    std::optional<Multiplier> multiplier;
    RangePhrase range;
    Place place;
};
struct Initialize {
    std::array<std::optional<double>, 6> velocity;
    std::array<std::optional<double>, 3> displacement;
    std::array<std::optional<LinearNumber>, 6> stress; ///< sxx syy szz sxy sxz syz
    std::optional<LinearNumber> pore_pressure;
    RangePhrase range;
    Place place;
};
/// insitu topography [kx k] [ky k]: stress of the weight above; ratios of horizontal to vertical stress
struct Topography { double kx = 1, ky = 1; };
/// insitu stress sxx syy szz sxy sxz syz [xgrad ..] [ygrad ..] [zgrad ..]
struct InSitu {
    std::optional<std::array<double, 6>> stress;
    std::array<double, 6> x_gradient{}, y_gradient{}, z_gradient{};
    std::optional<Topography> topography;
    std::optional<LinearNumber> pore_pressure;
    RangePhrase range;
    Place place;
};
/// table n x y ... | table n read file | table n clear
struct TableCommand {
    std::int64_t number = 0;
    std::vector<std::array<double, 2>> points;
    std::string file;
    bool clear = false;
    Place place;
};
/// water table x y z [normal ..] [density d] | water pressure p [gradient ..] | water off
struct WaterCommand {
    enum class Kind { off, table, pressure, ground };
    std::optional<Kind> kind;
    Vec3 origin = Vec3::Zero(), normal = Vec3(0, 0, 1), gradient = Vec3::Zero();
    double density = 1000, pressure = 0;
    std::string file; ///< of the ground surface that is the water table
    Place place;
};
struct Reset {
    enum class What { time, histories, displacements, velocities, joint_displacements, energy, damping };
    std::vector<What> what;
};

// --- histories and output --------------------------------------------------------------------------
struct HistoryItem {
    struct Quantity { std::string word; }; ///< one of recorded_words(): unbal, xdis, sstr, szz, ...
    struct Own { std::string name; };      ///< what the nearest sub-contact has for itself
    struct Script { std::string symbol; }; ///< without @
    std::variant<Quantity, Own, Script> what;
    Vec3 place = Vec3::Zero();
    Place text;
};
struct HistoryAdd {
    std::vector<HistoryItem> items;
    std::optional<std::int64_t> interval; ///< ncyc
    std::optional<std::int64_t> number;   ///< of the first item, where the deck says it
    Place place;
};
struct HistoryDelete { std::vector<std::int64_t> numbers; Place place; };
struct HistoryLabel { std::int64_t number = 0; std::string text; Place place; };
struct HistoryWrite {
    std::vector<std::int64_t> numbers; ///< none: all
    std::optional<std::int64_t> versus; ///< vs m
    std::string file;                   ///< none: the deck's name with .csv
    Place place;
};
struct VtkWrite { std::string file; };
struct List {
    enum class What {
        blocks, quality, contacts, sub_contacts, gridpoints, zones, faces, properties, histories, extremes, time, unbalanced,
        damping, information, time_step, timing, energy, hash, joint_models, boundary, groups, excavated, states, stresses,
        stability, structures, joint_sets, memory, version, settings, tables, ranges, symbols
    };
    std::optional<What> what;         ///< none: `symbols` only
    std::vector<std::string> symbols; ///< print @a @b: without @
    std::optional<std::int64_t> number; ///< list hist n, list prop jmat n
    enum class Part { all, blocks, joints } part = Part::all; ///< list prop mat | jmat
    RangePhrase range;
};
struct Ignored { std::string word, instead; }; ///< label, ...: read to its end; `instead`: what there is in its place
/// plot: hundreds of forms, looked at when it runs, so that no word of it stops a deck.
struct Plot {
    struct Item {
        std::string text, folded; ///< without quotes or @
        bool quoted = false, script = false; ///< a text; @name or [expression]
    };
    std::vector<Item> words;
    std::string range; ///< from the word `range` on, "" without one
    Place place;
};
struct Movie { std::vector<Plot::Item> words; Place place; };

// --- solution ---------------------------------------------------------------------------------------
struct CycleCommand { std::optional<std::int64_t> cycles; std::optional<double> time; };
struct Solve {
    std::optional<double> ratio, maximum_ratio, local_ratio; ///< ratio: the average one
    std::optional<double> force, time, clock;                ///< clock in minutes
    std::optional<std::int64_t> cycles;
    bool elastic = false;
    bool factor_of_safety = false;
    bool still = false; ///< a ratio or a force counts only when no body gains displacement any more
    std::optional<std::array<double, 2>> bracket; ///< of the factor: where it stands and where it fails
    double resolution = 0.005;                    ///< of the factor, as a part of it
    std::string file;                             ///< where the failing state is saved
    enum class Reduced { joints, zones, friction, cohesion, tension };
    std::vector<Reduced> included, excluded; ///< of fos: what is reduced; none included: everything
    bool keep = false;                       ///< of fos: the model stays as it failed
    Place place;
};
/// limit equilibrium
struct LimitEquilibrium {
    enum class Method { ordinary, bishop, janbu, spencer, morgenstern_price };
    enum class Surfaces { circles, polylines };
    std::vector<Method> methods;           ///< none: the usual ones
    std::optional<Vec3> origin, direction; ///< of the section
    std::optional<Vec3> circle;            ///< distance, height, radius
    std::vector<std::array<double, 2>> surface; ///< distance, height
    Surfaces search = Surfaces::circles;   ///< when no surface is given
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
/// structure property: what cables are made of
struct StructureProperty {
    struct Item { std::string name; double value = 0; };
    std::int64_t number = 1;
    std::vector<Item> items;
    Place place;
};
struct StructureDelete { std::optional<std::int64_t> number; RangePhrase range; };
struct Damp {
    enum class Kind { none, local, global, combined, rayleigh };
    std::optional<Kind> kind;            ///< none given: as it was
    std::optional<double> value;         ///< local 0.8
    double fraction = 0, frequency = 0;  ///< rayleigh
    bool mass = true, stiffness = true;
    std::optional<double> contact;       ///< dashpots of contacts, of critical damping
};
/// One of the three: all masses, none, or what the step asks for.
struct MassScale { bool on = false, off = false; std::optional<double> step; };
struct Fraction { double value = 0; };

// --- scripts -----------------------------------------------------------------------------------------
/// def NAME ... end: all its lines, the first and the last included; place is that of the first line.
struct FishDefinition { std::string text; Place place; };
/// fish callback add NAME [place in the cycle] [interval n], fish callback remove NAME; set fishcall n NAME.
struct FishCallback {
    enum class When { before_cycle, after_forces, after_cycle };
    std::string function;
    bool remove = false;
    When when = When::after_forces;
    std::int64_t interval = 1;
    Place place;
};
/// param name = value: the first value of a name counts, and kaya --set gives it before the deck does.
struct Parameter { std::string name; Value value; Place place; };
struct FishCall { std::string expression; Place place; }; ///< a line @f(1) or [f(1)]: without @ and brackets
struct LuaChunk { std::string text; Place place; }; ///< the lines between lua and endlua; place of the first
struct LuaFile { std::string file; Place place; };

// --- all of them ---------------------------------------------------------------------------------------
struct NotSupportedYet {}; ///< known by name, and refused when the deck is read

/// Those that nobody has to run.
using OwnCommands = CommandList<CallFile, Return, Quit, NotSupportedYet>;

// By the files of src/commands that run them. A command that stands in no list does not compile where its words are, and one that
// stands in a list and has no handler does not compile in that file.
using ControlCommands = CommandList<New, Config, Title, Pause, Set, NameRange>;
using FileCommands = CommandList<Save, Restore, HistoryWrite, VtkWrite, Ignored>;
using ShapeCommands = CommandList<PolyBrick, PolyPrism, PolyFace, PolyTet, PolyCube, PolyDrum, PolyTunnel>;
using CutCommands = CommandList<JointSetCommand, TunnelCommand, CutGround, Densify, Join, JoinContact>;
using ExchangeCommands = CommandList<Import, Export>;
using SelectionCommands = CommandList<Group, Mark, MarkJoint, Excavate, Fill, Copy>;
using GeometryCommands = CommandList<Hide, Seek, Delete, FaceTriangulation, GenerateEdge, GenerateQuad>;
using MaterialCommands = CommandList<Property, Change, JointModelCommand, JointModelTest>;
using ZoneModelCommands = CommandList<ZoneModelCommand, ZoneAveraging>;
using BoundaryCommands = CommandList<Fix, Free, Gravity, Boundary, Apply, Reset>;
using InitialStateCommands = CommandList<Initialize, InSitu>;
using TableCommands = CommandList<TableCommand>;
using WaterCommands = CommandList<WaterCommand>;
using SlopeCommands = CommandList<LimitEquilibrium>;
using StructureCommands = CommandList<StructureCable, StructureProperty, StructureDelete>;
using HistoryCommands = CommandList<HistoryAdd, HistoryLabel, HistoryDelete>;
using ListCommands = CommandList<List>;
using PlotCommands = CommandList<Plot>;
using MovieCommands = CommandList<Movie>;
using SolutionCommands = CommandList<CycleCommand, Solve, Damp, MassScale, Fraction>;
using ScriptCommands = CommandList<FishDefinition, FishCall, FishCallback, LuaChunk, LuaFile, Parameter>;

using HandledCommands =
    CommandLists<ControlCommands, FileCommands, ShapeCommands, CutCommands, ExchangeCommands, SelectionCommands, GeometryCommands,
                 MaterialCommands, ZoneModelCommands, BoundaryCommands, InitialStateCommands, TableCommands, WaterCommands, SlopeCommands,
                 StructureCommands, HistoryCommands, ListCommands, PlotCommands, MovieCommands, SolutionCommands, ScriptCommands>;
using Commands = JoinedLists<OwnCommands, HandledCommands>::All;

template <class Command> inline constexpr std::size_t index_of = index_in<Command>(Commands{});

/// Of commands that a script gives inside a cycle: those that read, or write what may be written at any time, and those that would
/// cycle inside a cycle or take away the model that is cycling. The others change the structure, and wait for the end of the cycle.
using RunInCycle = CommandList<Title, Pause, NameRange, Mark, Hide, Seek, Group, Gravity, Initialize, TableCommand, HistoryLabel, HistoryWrite,
                               List, Plot, Movie, Ignored, FishDefinition, FishCall, FishCallback, LuaChunk, LuaFile>;
using RefusedInCycle = CommandList<New, Restore, LimitEquilibrium, CycleCommand, Solve>;

} // namespace kaya::lang
