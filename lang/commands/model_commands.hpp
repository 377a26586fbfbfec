// The commands of model control, geometry and materials as structs.
#pragma once

#include "base/object_kind.hpp"
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
struct Config {
    bool dynamic = false;
};
struct CallFile {
    std::string file;
};
struct Return {};
struct Quit {};
struct Title {
    std::string text;
};
struct Save {
    std::string file;
};
struct Restore {
    std::string file;
};
struct Pause {};
/// dialect both|classic|modern: the binder follows the line; nothing runs
struct ReadDialect {};

/// One `set` line may hold several settings; settings that are not given are unchanged.
struct Set {
    std::optional<bool> dynamic;                            ///< dyn on|off
    std::optional<bool> small;                              ///< small on|off
    std::optional<bool> log;                                ///< log on|off
    std::optional<std::string> log_file;                    ///< logfile f
    bool empty_log = false;                                 ///< of log and logfile: the file begins empty
    std::optional<std::int64_t> default_joint_constitutive; ///< jcondf
    std::optional<std::int64_t> default_joint_material;     ///< jmatdf
    std::optional<double> time_step_fraction;               ///< fraction
    std::optional<double> time_step;                        ///< dt; 0: computed
    std::optional<std::int64_t> threads;
    std::optional<double> autosave; ///< minutes; 0: none
    std::optional<bool> echo;
    std::optional<bool> report; ///< report on|off
    std::optional<Vec3> gravity;
    std::optional<std::string> units;                ///< units SYSTEM
    std::optional<std::int64_t> seed;                ///< random n: of urand and grand
    std::optional<bool> as_3dec;                     ///< compatibility 3dec|none
    std::vector<std::pair<std::string, Value>> fish; ///< set @name = value; the name is without @
};

// --- geometry -----------------------------------------------------------------------------------
struct BlockOptions {
    std::int64_t region = 0, material = 1, constitutive = 1;
    std::string group; ///< "": none
};
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
struct PolyTet {
    std::vector<Vec3> corners;
    BlockOptions options;
    Place place;
};
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
    double tolerance = 0; ///< cuts nearer than this to a corner are not made
    double persistence = 1;
    std::optional<std::int64_t> id; ///< none: the next that is free
    std::int64_t seed = 0;
    bool join = false; ///< the pieces of a block remain one body
    RangePhrase range;
    Place place;
};
/// The outline of a tunnel: two polygons with matching corners.
struct TunnelCommand {
    std::vector<Vec3> first, second; ///< outlines at both ends
    std::vector<Vec3> path;          ///< of the first outline, in place of the second
    std::int64_t region = 0;         ///< of the blocks inside; 0: unchanged
    bool radial = false;             ///< cuts the rock around through each corner, too
    bool join = false;               ///< pieces on one side remain one body
    RangePhrase range;
    Place place;
};
/// cut ground: along a ground surface.
struct CutGround {
    std::string file;
    Vec3 shift = Vec3::Zero();
    std::optional<std::int64_t> id;     ///< of the faces that are cut
    std::optional<std::int64_t> region; ///< of the blocks below
    RangePhrase range;
    Place place;
};
/// cut surface: along the surface of bodies, or a surface that may overhang.
struct CutSurface {
    std::string file;
    Vec3 shift = Vec3::Zero();
    std::optional<std::int64_t> id;     ///< of the faces that are cut
    std::optional<std::int64_t> region; ///< of the blocks inside or below
    bool join = false;                  ///< the pieces of a block remain one body
    RangePhrase range;
    Place place;
};
/// Cuts each block into equal parts along x, y and z.
struct Densify {
    std::array<std::int64_t, 3> parts{1, 1, 1};
    bool join = false; ///< the parts remain one body
    RangePhrase range;
    Place place;
};
/// Blocks from a file: the suffix selects the format.
struct Import {
    std::string file;
    BlockOptions options;
    bool stop = false;          ///< at the first wrong body; otherwise it is left out
    double scale = 1;           ///< of the coordinates
    char up = 'z';              ///< the axis of the file that points up
    double mend = 0, holes = 0; ///< lengths of the model, 0: none
    std::int64_t simplify = 0;  ///< greatest number of triangles of a body, 0: any
    double deviation = 0;       ///< greatest length by which surfaces may move to have fewer triangles, 0: none
    std::int64_t convex = 0;    ///< greatest number of convex parts of a body, 0: as many as it has
    Place place;
};
struct Export {
    std::string file;
    RangePhrase range;
    Place place;
};
struct Mark {
    std::int64_t region = 0;
    RangePhrase range;
};
/// Gives faces, and the contacts on them, the number of a joint set.
struct MarkJoint {
    std::int64_t joint_set = 0;
    RangePhrase range;
};
/// Joins adjacent blocks into one body, or separates joined blocks.
struct Join {
    bool on = true;
    RangePhrase range;
    Place place;
};
/// Joins the two blocks of each contact.
struct JoinContact {
    RangePhrase range;
    Place place;
};
struct Hide {
    RangePhrase range;
};
struct Seek {
    RangePhrase range;
};
struct Delete {
    RangePhrase range;
};
/// Removes blocks and stores them; fill restores them.
struct Excavate {
    RangePhrase range;
};
struct Fill {
    RangePhrase range;
};
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
    std::string name;                    ///< or `slot=name`
    bool remove = false;                 ///< takes the objects out of the group
    RangePhrase range;
};
struct NameRange {
    std::string name;
    RangePhrase range;
    bool remove = false;
}; ///< range name NAME elements, range delete NAME
/// facetri radial | rad8 | edge f | off: triangles of faces of rigid blocks, for their contacts
struct FaceTriangulation {
    enum class Style { fan, radial, radial_8, edge } style = Style::fan;
    double edge = 0;
    RangePhrase range;
    Place place;
};
/// generate edge f [center x y z edgelength-center f edgelength-distance f distance f]: edges everywhere, or far from the centre.
struct GenerateEdge {
    std::optional<double> edge;
    std::optional<Vec3> center;
    std::optional<double> at_center, at_distance, distance;
    RangePhrase range;
    Place place;
};
/// generate quad n1 n2 n3: blocks with eight corners are cut in cells along their own axes.
struct GenerateQuad {
    std::array<std::int64_t, 3> parts{1, 1, 1};
    std::array<double, 3> ratio{1, 1, 1}; ///< of each cell to the one before it
    bool given = false;                   ///< the line gives the number
    RangePhrase range;
    Place place;
};

// --- surfaces and fractures -----------------------------------------------------------------------
/// geometry set|import|polygon create|delete: plane polygons under a name, for cuts.
struct GeometryCommand {
    enum class Action { choose, import, write, polygon, remove } action = Action::choose;
    std::string set;  ///< "": the current one
    std::string file; ///< of import and export
    std::vector<Vec3> corners;
    std::optional<Vec3> extrude; ///< closes a prism from the polygon to its copy, moved by this
    Place place;
};
/// Which fractures a command is about: those that meet all that is given.
struct FractureChoice {
    std::optional<std::string> network;             ///< none: all networks
    std::optional<std::array<std::int64_t, 2>> ids; ///< the first and the last
    std::optional<std::array<double, 2>> sizes;     ///< diameters
    std::string group;                              ///< "": any; name or slot=name
};
/// fracture create: a disc of a network of fractures.
struct FractureCommand {
    std::string network; ///< "": the network without a name
    Vec3 position = Vec3::Zero();
    double dip = 0, dip_direction = 0, size = 1; ///< degrees; size: the diameter
    std::string group;
    std::int64_t dominance = 0;
    Place place;
};
/// fracture delete|copy|truncate|combine|group|cluster: changes networks.
struct FractureChange {
    enum class What { remove, copy, truncate, combine, group, cluster } what = What::remove;
    FractureChoice choice;
    std::optional<std::array<double, 6>> box; ///< remove: those that do not reach it; truncate: nothing is left outside
    double share = 1;                         ///< remove: chance of each
    std::int64_t seed = 1;
    std::optional<std::int64_t> sides;     ///< truncate, combine: of the polygon for a disc, 12 if not given
    std::string name;                      ///< copy: network; group: name or slot=name; cluster: slot
    bool out = false;                      ///< group remove
    std::optional<double> angle, distance; ///< combine; degrees
    enum class Joining { turn, collapse, merge, hull } joining = Joining::turn;
    Place place;
};
/// fracture template create|delete: orientations and sizes to draw fractures from.
struct FractureTemplate {
    std::string name;
    bool remove = false;
    enum class Orientation { uniform, fisher, gauss, bootstrapped } orientation = Orientation::uniform;
    std::array<double, 4> angles{}; ///< dip, direction, kappa; or dip, its deviation, direction, its deviation; degrees
    std::string planes;             ///< file of bootstrapped orientations
    enum class Size { power_law, log_normal, gauss, exponential, uniform, bootstrapped };
    std::optional<Size> size;
    std::array<double, 2> sizes{}; ///< exponent; or mean, deviation
    std::string diameters;         ///< file of bootstrapped sizes
    std::optional<std::array<double, 2>> dip_limits, dip_direction_limits, size_limits;
    Place place;
};
/// fracture generate: fractures drawn from a template.
struct FractureGenerate {
    std::string source;  ///< the template; "": the one that was made last
    std::string network; ///< "": the network without a name
    std::optional<std::int64_t> count;
    std::optional<double> area;      ///< per volume of the box
    std::optional<double> crossings; ///< per length of the line
    std::optional<double> percolation;
    std::array<Vec3, 2> line{Vec3::Zero(), Vec3::Zero()};
    std::optional<std::array<double, 6>> box; ///< least and greatest x, y, z; none: that around the model
    std::int64_t seed = 1;
    std::string group;
    std::int64_t dominance = 0;
    Place place;
};
/// What the lines of a file of fractures are.
enum class FractureLines { discs, polygons, traces, fracman };
/// fracture import from-file FILE.
struct FractureImport {
    std::string file;
    std::string network; ///< "": the network without a name
    FractureLines format = FractureLines::discs;
    std::string group;
    std::int64_t dominance = 0;
    Place place;
};
/// fracture export file FILE.
struct FractureExport {
    std::string file;
    FractureLines format = FractureLines::discs; ///< not traces
    std::int64_t sides = 12;                     ///< of the polygon for a disc
    FractureChoice choice;
    Place place;
};
/// fracture compute|list|intersections: what is measured on fractures.
struct FractureMeasure {
    enum class What {
        list,
        intersections,     ///< one line each
        intersection_sums, ///< how many
        crossings,
        area,
        number,
        percolation,
        trace_length, ///< mean of a trace
        trace_area,   ///< length of traces over the area of the set
        trace_number  ///< centres of traces over the area of the set
    } what = What::list;
    std::array<Vec3, 2> line{Vec3::Zero(), Vec3::Zero()};
    std::optional<std::array<double, 6>> box;
    std::string set;                    ///< of polygons, for traces
    std::optional<std::int64_t> option; ///< of percolation: how fractures count that cross the box
    FractureChoice choice;
    Place place;
};
/// cut geometry SET: by the plane of each polygon.
struct CutPolygons {
    std::string set;
    std::optional<std::int64_t> id; ///< joint set of the faces; none: the next that is free
    bool join = false;              ///< the pieces of a block remain one body
    RangePhrase range;
    Place place;
};

/// cut dfn NETWORK: by its fractures.
struct CutFractures {
    std::string network;
    std::optional<std::int64_t>
        id;                  ///< joint set of the first fracture; none: the one that it has, or the next free one
    bool limited = false;    ///< the cut ends with the fracture
    std::int64_t sides = 12; ///< of the polygon for a disc that ends in a block
    double persistence = 1;  ///< chance that a block in the way of a fracture is cut
    double tolerance = 0;    ///< no piece gets a shorter edge
    std::int64_t seed = 0;
    bool join = false; ///< the pieces of a block remain one body
    RangePhrase range;
    Place place;
};

// --- materials ----------------------------------------------------------------------------------
/// prop mat n | jmat n  word value ...: words are the classic ones (dens, bulk, k, g, ymod, jkn, ...) and the properties of loaded joint
/// models, which are known at run time only.
struct Property {
    bool joint = false; ///< `jmat` was typed
    std::int64_t number = 1;
    struct Item {
        std::string word;
        double value;
        Place place;
        bool is_switch = false;
    }; ///< a switch: `on` or `off` was typed
    std::vector<Item> items;
};
struct Change {
    std::optional<std::int64_t> material, constitutive, joint_material, joint_constitutive;
    RangePhrase range;
};
/// jmodel test NAME FILE [steps n] [area a] [word value ...]: one sub-contact; the model of the deck is unchanged.
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
    std::optional<double> density; ///< of the blocks themselves: block zone property density
    RangePhrase range;
};
/// block property density: of the blocks in range, which get a separate material when others share theirs.
struct BlockDensity {
    double density = 0;
    RangePhrase range;
    Place place;
};
/// block contact material-table default: joint model and properties of contacts that are found from now on.
struct NewContacts {
    std::string model; ///< "": unchanged
    Place model_place;
    std::vector<Property::Item> items;
    Place place;
};
/// block contact material-table add|modify|remove|list|apply: joint models of new contacts by range. The first entry that fits counts.
struct JointRuleCommand {
    enum class Action { add, modify, remove, list, apply } action = Action::add;
    std::optional<std::int64_t> number; ///< of the entry, from 1; none: all
    std::string model;                  ///< "": unchanged
    Place model_place;
    std::vector<Property::Item> items;
    RangePhrase range;
    Place place;
};
/// block contact generate-subcontacts: contacts are found now, not at the first command that needs them.
struct FindContacts {};
/// zone nmd on|off: mixed discretisation.
struct ZoneAveraging {
    bool on = true;
};

} // namespace kaya::lang
