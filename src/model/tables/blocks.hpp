// Blocks, their gridpoints (of a rigid block: its vertices), faces and zones.
#pragma once

#include "base/id.hpp"
#include "geometry/overlay/overlay.hpp"
#include "model/tables/column.hpp"

#include "kaya/jmodel.h"

#include <cstdint>

namespace kaya {

struct BlockTag {};
using BlockId = Id<BlockTag>;

/// Rows [first, first + count) of another table.
struct Span {
    Row first = 0;
    Row count = 0;
    Row end() const { return first + count; }
    bool operator==(const Span&) const = default;
};

/// Bits of Blocks::fixed and Gridpoints::fixed: a component whose velocity is prescribed.
enum Fixity : std::uint8_t { fix_x = 1, fix_y = 2, fix_z = 4, fix_rx = 8, fix_ry = 16, fix_rz = 32, fix_all = 63 };

/// A quaternion as plain numbers: w, x, y, z.
using Quaternion = Eigen::Vector4d;

class Gridpoints;
class Faces;
class Triangles;
class Zones;

class Blocks : public Table<Blocks> {
public:
    IdMap<BlockTag> ids;

    Column<BlockId> id;
    Column<std::int32_t> number;       ///< counts from 1 in order of creation; what users see
    Column<std::int32_t> material;     ///< number of `prop mat`
    Column<std::int32_t> constitutive; ///< number of `change cons`
    Column<Row> zone_properties;       ///< row of Model::zone_properties; 0: by `constitutive`
    Column<std::int32_t> region;
    Column<std::int32_t> group; ///< index into Model::group_names, 0 is none
    Column<std::int32_t> body;  ///< blocks of equal body move as one (joined.hpp); 0: on its own
    Column<std::int32_t>
        shape; ///< number of its surface and mesh, no two alike: another after each cut and each meshing
    Column<std::int32_t>
        tied_shape; ///< its shape when its ties to the other blocks of its body were made (ties.hpp), 0: not yet
    Column<std::uint8_t> hidden;
    Column<std::uint8_t> deformable;
    Column<std::uint8_t> fixed;           ///< Fixity bits, rigid blocks
    Column<FaceTriangles> face_triangles; ///< for contacts of a rigid block
    Column<double> face_edge; ///< about how far apart sub-contacts on its faces are; 0: at corners and crossings only
    Column<Span> gridpoints;  ///< a block's rows are contiguous and in block order
    Column<Span> faces;
    Column<Span> triangles;
    Column<Span> zones;
    Column<std::int32_t> cell_zones; ///< zones per cell of `gen quad`, which are consecutive; 0: no cells
    Column<double> volume;           ///< length^3
    Column<double> margin;    ///< distance within which another surface counts as in contact: a small part of its size
    Column<double> travelled; ///< longest displacement of one of its points since its last contact check
    Column<double> mass;      ///< 0 until the density is known (at the first cycle)
    Column<double> inertial_mass; ///< in the equation of motion; another than `mass` where density is scaled
    Column<Mat3> inertia;         ///< of unit density, about the centroid, in the block's own axes
    Column<Vec3> centroid;
    Column<Quaternion> orientation;   ///< turns own axes into global ones
    Column<Vec3> velocity;            ///< rigid blocks, of the centroid
    Column<Vec3> rotational_velocity; ///< global axes, rad/time
    Column<Vec3> angular_momentum;    ///< about the centroid, global axes; conserved in free rotation. Of a
                                      ///< joined body: all of it, at its first block
    Column<Vec3> displacement;        ///< of the centroid
    Column<Vec3> force;               ///< sum of the last cycle, gravity and damping not included
    Column<Vec3> moment;
    Column<Vec3> load;   ///< applied force, wherever on the block it acts
    Column<Vec3> torque; ///< applied moment
    Column<Mat3>
        load_arms; ///< sum of arm (own axes, from the centroid) times force (global axes) over the loaded points
    Column<Vec3> last_force; ///< sum of all forces one step ago, for combined damping
    Column<Vec3> last_moment;

    template <class Visit> void columns(Visit&& visit) {
        visit("id", id, Role::identity);
        visit("number", number, Role::identity);
        visit("material", material, Role::setting);
        visit("constitutive", constitutive, Role::setting);
        visit("zone_properties", zone_properties, setting<ZoneProperties>());
        visit("region", region, Role::setting);
        visit("group", group, setting<Group>());
        visit("body", body, Role::link);
        visit("shape", shape, Role::identity);
        visit("tied_shape", tied_shape, Role::link);
        visit("hidden", hidden, Role::setting);
        visit("deformable", deformable, Role::geometry);
        visit("fixed", fixed, Role::condition);
        visit("face_triangles", face_triangles, Role::setting);
        visit("face_edge", face_edge, Role::setting);
        visit("gridpoints", gridpoints, link<Gridpoints>());
        visit("faces", faces, link<Faces>());
        visit("triangles", triangles, link<Triangles>());
        visit("zones", zones, link<Zones>());
        visit("cell_zones", cell_zones, Role::geometry);
        visit("volume", volume, Role::geometry);
        visit("margin", margin, Role::geometry);
        visit("travelled", travelled, Role::state);
        visit("mass", mass, Role::geometry);
        visit("inertial_mass", inertial_mass, Role::geometry);
        visit("inertia", inertia, Role::geometry);
        visit("centroid", centroid, Role::geometry);
        visit("orientation", orientation, Role::geometry);
        visit("velocity", velocity, Role::motion);
        visit("rotational_velocity", rotational_velocity, Role::motion);
        visit("angular_momentum", angular_momentum, Role::motion);
        visit("displacement", displacement, Role::displacement);
        visit("force", force, Role::state);
        visit("moment", moment, Role::state);
        visit("load", load, Role::load);
        visit("torque", torque, Role::load);
        visit("load_arms", load_arms, Role::load);
        visit("last_force", last_force, Role::state);
        visit("last_moment", last_moment, Role::state);
    }
};

/// Corners of zones; of a rigid block its vertices, which follow the block.
class Gridpoints : public Table<Gridpoints> {
public:
    Column<Row> block;
    Column<std::uint8_t> fixed; ///< Fixity bits x y z
    Column<double> mass;
    Column<double> inertial_mass; ///< in the equation of motion
    Column<Vec3> position;
    Column<Vec3> reference; ///< position when the zones were made; of a rigid block's vertex: in own axes
    Column<Vec3> velocity;  ///< of deformable blocks; a rigid block's vertex: gridpoint_velocity (measure.hpp)
    Column<Vec3> displacement;
    Column<Vec3> force;            ///< sum of the last cycle, gravity and damping not included
    Column<Vec3> load;             ///< applied force
    Column<Vec3> last_force;       ///< sum of all forces one step ago, for combined damping
    Column<std::int32_t> roller;   ///< index into Model::rollers, 0 is none
    Column<double> pore_pressure;  ///< where the settings take water from gridpoints
    Column<double> zone_frequency; ///< bound of the zones' part of its frequency with its true mass, (rad/time)^2

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("fixed", fixed, Role::condition);
        visit("mass", mass, Role::geometry);
        visit("inertial_mass", inertial_mass, Role::geometry);
        visit("position", position, Role::geometry);
        visit("reference", reference, Role::geometry);
        visit("velocity", velocity, Role::motion);
        visit("displacement", displacement, Role::displacement);
        visit("force", force, Role::state);
        visit("load", load, Role::load);
        visit("last_force", last_force, Role::state);
        visit("roller", roller, condition<Roller>());
        visit("pore_pressure", pore_pressure, Role::condition);
        visit("zone_frequency", zone_frequency, Role::geometry);
    }
};

/// Plane polygons that bound a block.
class Faces : public Table<Faces> {
public:
    Column<Row> block;
    Column<std::int32_t> joint_set; ///< 0: made with the block
    Column<std::uint8_t> open;      ///< not tied to a face of the same body: a fracture that ends inside of the body
    Column<std::int32_t> group;     ///< of the face itself: index into Model::group_names, 0 is none
    Column<Span> triangles;
    Column<Vec3> normal; ///< outward, unit, in the block's own axes

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("joint_set", joint_set, Role::setting);
        visit("open", open, Role::setting);
        visit("group", group, setting<Group>());
        visit("triangles", triangles, link<Triangles>());
        visit("normal", normal, Role::geometry);
    }
};

/// Bits of Triangles::quiet: which part of the velocity a quiet boundary brakes.
enum Quiet : std::uint8_t { quiet_x = 1, quiet_y = 2, quiet_z = 4, quiet_normal = 8, quiet_shear = 16 };

/// The surface of a block in triangles: of zones when it is deformable. Anticlockwise from outside.
class Triangles : public Table<Triangles> {
public:
    Column<Row> face;
    Column<std::array<Row, 3>> gridpoints;
    Column<std::uint8_t> quiet; ///< Quiet bits

    template <class Visit> void columns(Visit&& visit) {
        visit("face", face, link<Faces>());
        visit("gridpoints", gridpoints, link<Gridpoints>());
        visit("quiet", quiet, Role::condition);
    }
};

/// Linear tetrahedra of constant stress.
class Zones : public Table<Zones> {
public:
    Column<Row> block;
    Column<std::int32_t> group;            ///< of the zone itself: index into Model::group_names, 0 is none
    Column<std::array<Row, 4>> gridpoints; ///< positive volume in this order
    Column<Stress> stress;
    Column<Stress> dashpot;      ///< additional viscous stress; empty unless `keeps_dashpots` is set
    Column<double> volume;       ///< when the zones were made
    Column<std::uint32_t> state; ///< bits of the zone model
    std::array<Column<double>, KAYA_JMODEL_MAX_HISTORY>
        history;                      ///< of the zone model; those after `history_columns` are empty
    std::int32_t history_columns = 0; ///< the largest number that a zone model needs
    bool keeps_dashpots = false;      ///< whether damping needs viscous stresses

    // Of cells of six zones, for any zone model: docs/theory/zones.md, "Cells".
    std::array<Column<double>, 2> warp; ///< stresses of warping, twelve for a cell: six in its rows of each column
    std::array<Column<double>, 2> warp_dashpot; ///< their viscous parts
    Column<Stress>
        initial; ///< where the zones of a cell began with different stresses: what no motion of the cell made
    Column<std::uint8_t>
        layered; ///< whether the stresses of a cell's zones hold those of its layers, which `warp` holds else
    bool keeps_warps = false, keeps_warp_dashpots = false, keeps_initial = false, keeps_layers = false;

    /// Allocates viscous stresses; they are never released.
    void keep_dashpots() {
        if (keeps_dashpots) return;
        keeps_dashpots = true;
        dashpot.assign(size(), Stress::Zero());
    }

    /// Allocates columns for cells; they are never released.
    void keep_warps() { keep(keeps_warps, warp); }
    void keep_warp_dashpots() { keep(keeps_warp_dashpots, warp_dashpot); }
    void keep_initial() {
        if (!keeps_initial) initial.assign(size(), Stress::Zero());
        keeps_initial = true;
    }
    void keep_layers() {
        if (!keeps_layers) layered.assign(size(), 0);
        keeps_layers = true;
    }
    /// Allocates the columns that another table has.
    void keep_as(const Zones& other) {
        if (other.keeps_dashpots) keep_dashpots();
        if (other.keeps_warps) keep_warps();
        if (other.keeps_warp_dashpots) keep_warp_dashpots();
        if (other.keeps_initial) keep_initial();
        if (other.keeps_layers) keep_layers();
        keep_history(static_cast<std::size_t>(other.history_columns));
    }

    /// Allocates history columns for a zone model; they are never released.
    void keep_history(std::size_t columns) {
        while (static_cast<std::size_t>(history_columns) < columns) history[history_columns++].assign(size(), 0.0);
    }

    /// Clears the zone model's history of a zone.
    void forget(Row zone) {
        state[zone] = 0;
        for (std::int32_t k = 0; k < history_columns; ++k) history[k][zone] = 0;
    }

    template <class Visit> void columns(Visit&& visit) {
        visit("block", block, link<Blocks>());
        visit("group", group, setting<Group>());
        visit("gridpoints", gridpoints, link<Gridpoints>());
        visit("stress", stress, Role::state);
        if (keeps_dashpots) visit("dashpot", dashpot, Role::state);
        visit("volume", volume, Role::geometry);
        visit("state", state, Role::state);
        for (std::size_t k = 0; k < history.size() && static_cast<std::int32_t>(k) < history_columns; ++k)
            visit("history_" + std::to_string(k), history[k], Role::state);
        for (std::size_t k = 0; keeps_warps && k < warp.size(); ++k)
            visit("warp_" + std::to_string(k), warp[k], Role::state);
        for (std::size_t k = 0; keeps_warp_dashpots && k < warp_dashpot.size(); ++k)
            visit("warp_dashpot_" + std::to_string(k), warp_dashpot[k], Role::state);
        if (keeps_initial) visit("initial_stress", initial, Role::state);
        if (keeps_layers) visit("layered", layered, Role::state);
    }

private:
    void keep(bool& keeps, std::array<Column<double>, 2>& columns) {
        if (keeps) return;
        keeps = true;
        for (auto& column : columns) column.assign(size(), 0.0);
    }
};

} // namespace kaya
