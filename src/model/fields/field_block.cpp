// Quantities of blocks.
#include "model/edit/placed_loads.hpp"
#include "model/fields/field_rows.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/turn.hpp"

#include <algorithm>
#include <fmt/format.h>

#include <Eigen/Geometry>

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::block;
constexpr auto rows_of = &Model::blocks;

/// True when every component of the block's motion is prescribed.
std::int64_t fixed(const Model& model, Row block) {
    if (!model.blocks.deformable[block]) return (model.blocks.fixed[block] & fix_all) == fix_all;
    constexpr int all_axes = fix_x | fix_y | fix_z;
    const Span span = model.blocks.gridpoints[block];
    for (Row i = span.first; i < span.end(); ++i)
        if ((model.gridpoints.fixed[i] & all_axes) != all_axes) return 0;
    return span.count > 0;
}

std::int64_t kind(const Model& model, Row block) { return model.blocks.deformable[block] ? 2 : 1; }

double surface_area(const Model& model, Row block) {
    double area = 0;
    const Span span = model.blocks.faces[block];
    for (Row face = span.first; face < span.end(); ++face) area += face_area_vector(model, face).norm();
    return area;
}

/// Mass in the equation of motion over true mass; 1 before masses are known.
double density_scaling(const Model& model, Row block) {
    const double mass = model.blocks.mass[block];
    return mass > 0 ? model.blocks.inertial_mass[block] / mass : 1;
}

/// The next block that is joined with this one.
FieldValue next_joined(const Model& model, Row block) {
    const auto& body = model.blocks.body;
    Row next = block + 1;
    const auto rows = static_cast<Row>(body.size());
    while (next < rows && body[next] != body[block]) ++next;
    return Link{ObjectKind::block, body[block] != 0 && next < rows ? next : no_row};
}

void set_velocity(Model& model, Row block, const FieldValue& value) {
    const Vec3 velocity = vector(value);
    model.blocks.velocity[block] = velocity;
    if (!model.blocks.deformable[block]) return;
    const Span span = model.blocks.gridpoints[block];
    for (Row i = span.first; i < span.end(); ++i) model.gridpoints.velocity[i] = velocity;
}

template <int k> void set_velocity_component(Model& model, Row block, const FieldValue& value) {
    const double component = number(value);
    model.blocks.velocity[block][k] = component;
    if (!model.blocks.deformable[block]) return;
    const Span span = model.blocks.gridpoints[block];
    for (Row i = span.first; i < span.end(); ++i) model.gridpoints.velocity[i][k] = component;
}

void need_rigid(const Model& model, Row block) {
    if (model.blocks.deformable[block])
        throw Diagnostic(fmt::format("block {} is deformable and takes no load as a whole", model.blocks.number[block]),
                         "set the loads of its gridpoints");
}
void set_load(Model& model, Row block, const FieldValue& value) {
    need_rigid(model, block);
    forget_places(model, block, {0, 1, 2});
    model.blocks.load[block] = vector(value);
}
template <int k> void set_load_component(Model& model, Row block, const FieldValue& value) {
    need_rigid(model, block);
    forget_places(model, block, {k});
    model.blocks.load[block][k] = number(value);
}

/// Inertia about the centroid and global axes. Before the first cycle the density is that of the material,
/// NaN when it is not given.
Mat3 inertia(const Model& model, Row block) {
    const auto& blocks = model.blocks;
    double density = std::nan("");
    if (blocks.mass[block] > 0) density = blocks.mass[block] / blocks.volume[block];
    else if (const auto found = model.materials.find(blocks.material[block]); found != model.materials.end())
        density = found->second.density;
    const Mat3 turn = turn_of(blocks, block);
    return density * (turn * blocks.inertia[block] * turn.transpose());
}
Vec3 moments_of_inertia(const Model& model, Row block) { return inertia(model, block).diagonal(); }
/// The integral of x_i x_k dm about the centroid; the tensor holds it with the opposite sign.
template <int i, int k> double product_of_inertia(const Model& model, Row block) {
    return -inertia(model, block)(i, k);
}

/// The engine stores the angular momentum; the rotational velocity follows from it.
void rotate(Model& model, Row block, const Vec3& velocity) {
    if (model.blocks.body[block] != 0)
        throw Diagnostic(
            fmt::format("block {} is joined to others and cannot rotate separately", model.blocks.number[block]),
            "give it a rotation before `join`");
    if (model.blocks.deformable[block])
        throw Diagnostic(fmt::format("block {} is deformable and has no spin", model.blocks.number[block]),
                         "set the velocities of its gridpoints");
    const double mass = model.blocks.mass[block];
    const double factor = mass > 0 ? model.blocks.inertial_mass[block] / mass : 1; // of density scaling
    const Vec3 momentum = factor * (inertia(model, block) * velocity);
    if (!momentum.allFinite())
        throw Diagnostic(
            fmt::format("block {} has no density yet and cannot be given a rotation", model.blocks.number[block]),
            fmt::format("give the density of material {} before", model.blocks.material[block]));
    model.blocks.rotational_velocity[block] = velocity;
    model.blocks.angular_momentum[block] = momentum;
}
void set_rotation(Model& model, Row block, const FieldValue& value) { rotate(model, block, vector(value)); }
template <int k> void set_rotation_component(Model& model, Row block, const FieldValue& value) {
    Vec3 velocity = model.blocks.rotational_velocity[block];
    velocity[k] = number(value);
    rotate(model, block, velocity);
}

} // namespace

const Fields& block_fields() {
    static const Fields rows{
        {table, "id", "b_id", "block.id", "-", "number, from 1 in order of creation", read<rows_of, &Blocks::number>,
         nullptr},
        {table, "material", "b_mat", "", "-", "number of its material", read<rows_of, &Blocks::material>, nullptr},
        {table, "constitutive", "b_cons", "", "-", "number of its constitutive model",
         read<rows_of, &Blocks::constitutive>, nullptr},
        {table, "region", "b_region", "block.region", "-", "region number", read<rows_of, &Blocks::region>,
         write<rows_of, &Blocks::region>},
        {table, "group", "b_group", "block.group", "-", "name of its group, empty when it has none",
         read_group<ObjectKind::block>, write_group<ObjectKind::block>},
        {table, "body", "b_ms", "", "-", "number of the joined body that it is part of, 0 on its own",
         read<rows_of, &Blocks::body>, nullptr},
        {table, "next_joined", "b_msnext", "", "-", "next block of the same joined body, null at the end", next_joined,
         nullptr},
        {table, "type", "b_type", "", "-", "1 rigid, 2 deformable", call<kind>, nullptr},
        {table, "surface_area", "b_area", "block.area", "area", "sum of the areas of its faces", call<surface_area>,
         nullptr},
        {table, "density_scaling", "b_dsf", "block.dsf", "-", "mass in the equation of motion over true mass",
         call<density_scaling>, nullptr},
        {table, "hidden", "b_hidden", "block.hidden", "-", "1 when hidden", read<rows_of, &Blocks::hidden>, nullptr},
        {table, "deformable", "", "", "-", "1 when it has zones", read<rows_of, &Blocks::deformable>, nullptr},
        {table, "fixed", "b_fix", "block.fix", "-", "1 when all of its motion is prescribed", call<fixed>, nullptr},
        {table, "volume", "b_vol", "block.vol", "volume", "volume", read<rows_of, &Blocks::volume>, nullptr},
        {table, "mass", "b_mass", "block.mass", "mass", "mass, 0 before the first cycle", read<rows_of, &Blocks::mass>,
         nullptr},
        {table, "inertia", "b_moi", "block.moi", "mass*area", "moments of inertia about the centroid, global axes",
         call<moments_of_inertia>, nullptr},
        {table, "x_inertia", "b_xmoi", "block.moi.x", "mass*area", "about the x axis", call<moments_of_inertia, 0>,
         nullptr},
        {table, "y_inertia", "b_ymoi", "block.moi.y", "mass*area", "about the y axis", call<moments_of_inertia, 1>,
         nullptr},
        {table, "z_inertia", "b_zmoi", "block.moi.z", "mass*area", "about the z axis", call<moments_of_inertia, 2>,
         nullptr},
        {table, "xy_inertia", "", "", "mass*area", "product of inertia: the integral of x y dm about the centroid",
         call<product_of_inertia<0, 1>>, nullptr},
        {table, "xz_inertia", "", "", "mass*area", "the same of x z", call<product_of_inertia<0, 2>>, nullptr},
        {table, "yz_inertia", "", "", "mass*area", "the same of y z", call<product_of_inertia<1, 2>>, nullptr},
        {table, "position", "b_cent", "block.pos", "length", "centroid", call<block_centroid>, nullptr},
        {table, "x", "b_x", "block.pos.x", "length", "x of the centroid", call<block_centroid, 0>, nullptr},
        {table, "y", "b_y", "block.pos.y", "length", "y of the centroid", call<block_centroid, 1>, nullptr},
        {table, "z", "b_z", "block.pos.z", "length", "z of the centroid", call<block_centroid, 2>, nullptr},
        {table, "velocity", "b_vel", "block.vel", "length/time", "velocity of the centroid", call<block_velocity>,
         set_velocity},
        {table, "x_velocity", "b_xvel", "block.vel.x", "length/time", "x velocity", call<block_velocity, 0>,
         set_velocity_component<0>},
        {table, "y_velocity", "b_yvel", "block.vel.y", "length/time", "y velocity", call<block_velocity, 1>,
         set_velocity_component<1>},
        {table, "z_velocity", "b_zvel", "block.vel.z", "length/time", "z velocity", call<block_velocity, 2>,
         set_velocity_component<2>},
        {table, "rotational_velocity", "b_rvel", "block.rvel", "radians/time", "of a rigid block, global axes, radians",
         read<rows_of, &Blocks::rotational_velocity>, set_rotation},
        {table, "x_rotational_velocity", "b_rxvel", "block.rvel.x", "radians/time", "about the x axis",
         read<rows_of, &Blocks::rotational_velocity, 0>, set_rotation_component<0>},
        {table, "y_rotational_velocity", "b_ryvel", "block.rvel.y", "radians/time", "about the y axis",
         read<rows_of, &Blocks::rotational_velocity, 1>, set_rotation_component<1>},
        {table, "z_rotational_velocity", "b_rzvel", "block.rvel.z", "radians/time", "about the z axis",
         read<rows_of, &Blocks::rotational_velocity, 2>, set_rotation_component<2>},
        {table, "displacement", "", "", "length", "displacement of the centroid", call<block_displacement>, nullptr},
        {table, "x_displacement", "", "", "length", "x displacement", call<block_displacement, 0>, nullptr},
        {table, "y_displacement", "", "", "length", "y displacement", call<block_displacement, 1>, nullptr},
        {table, "z_displacement", "", "", "length", "z displacement", call<block_displacement, 2>, nullptr},
        {table, "force", "b_force", "block.force.unbal", "force",
         "unbalanced force of the last cycle, with loads and weight", call<unbalanced_force>, nullptr},
        {table, "x_force", "b_xforce", "block.force.unbal.x", "force", "x unbalanced force", call<unbalanced_force, 0>,
         nullptr},
        {table, "y_force", "b_yforce", "block.force.unbal.y", "force", "y unbalanced force", call<unbalanced_force, 1>,
         nullptr},
        {table, "z_force", "b_zforce", "block.force.unbal.z", "force", "z unbalanced force", call<unbalanced_force, 2>,
         nullptr},
        {table, "moment", "b_mom", "block.moment", "moment", "unbalanced moment of a rigid block",
         read<rows_of, &Blocks::moment>, nullptr},
        {table, "x_moment", "b_xmom", "block.moment.x", "moment", "x unbalanced moment",
         read<rows_of, &Blocks::moment, 0>, nullptr},
        {table, "y_moment", "b_ymom", "block.moment.y", "moment", "y unbalanced moment",
         read<rows_of, &Blocks::moment, 1>, nullptr},
        {table, "z_moment", "b_zmom", "block.moment.z", "moment", "z unbalanced moment",
         read<rows_of, &Blocks::moment, 2>, nullptr},
        {table, "load", "b_load", "block.force.app", "force", "applied force", call<block_load>, set_load},
        {table, "x_load", "b_xload", "block.force.app.x", "force", "x applied force", call<block_load, 0>,
         set_load_component<0>},
        {table, "y_load", "b_yload", "block.force.app.y", "force", "y applied force", call<block_load, 1>,
         set_load_component<1>},
        {table, "z_load", "b_zload", "block.force.app.z", "force", "z applied force", call<block_load, 2>,
         set_load_component<2>},
        {table, "first_gridpoint", "b_gp", "", "-", "first of its gridpoints",
         first<rows_of, &Blocks::gridpoints, ObjectKind::gridpoint>, nullptr},
        {table, "first_vertex", "b_vertex", "", "-", "first of its vertices",
         first<rows_of, &Blocks::gridpoints, ObjectKind::gridpoint>, nullptr},
        {table, "first_face", "b_face", "", "-", "first of its faces", first<rows_of, &Blocks::faces, ObjectKind::face>,
         nullptr},
        {table, "first_zone", "b_zone", "", "-", "first of its zones, null in a rigid block",
         first<rows_of, &Blocks::zones, ObjectKind::zone>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
