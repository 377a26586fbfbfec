// Quantities of gridpoints; of a rigid block these are its vertices.
#include "model/fields/field_rows.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/roller.hpp"

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::gridpoint;
constexpr auto rows_of = &Model::gridpoints;

/// A vertex of a rigid block follows its block: it has no separate velocity or load.
void need_deformable(const Model& model, Row gridpoint, const char* message, const char* hint) {
    if (!model.blocks.deformable[model.gridpoints.block[gridpoint]]) throw Diagnostic(message, hint);
}
Vec3& velocity_to_set(Model& model, Row gridpoint) {
    need_deformable(model, gridpoint, "the vertex of a rigid block follows its block and has no separate velocity",
                    "set the velocity of the block");
    return model.gridpoints.velocity[gridpoint];
}
Vec3& load_to_set(Model& model, Row gridpoint) {
    need_deformable(model, gridpoint, "a vertex of a rigid block has no separate load",
                    "give the block one (b_load, or apply ... at)");
    return model.gridpoints.load[gridpoint];
}
template <Vec3& (*of)(Model&, Row)> void set_vector(Model& model, Row gridpoint, const FieldValue& value) {
    of(model, gridpoint) = vector(value);
}
template <Vec3& (*of)(Model&, Row), int k> void set_component(Model& model, Row gridpoint, const FieldValue& value) {
    of(model, gridpoint)[k] = number(value);
}

/// As `initialize pp`: joints and zones take the pressures of gridpoints from now on.
void set_pore_pressure(Model& model, Row gridpoint, const FieldValue& value) {
    model.gridpoints.pore_pressure[gridpoint] = number(value);
    model.settings.water = Water::points;
}

double density_scaling(const Model& model, Row gridpoint) {
    const double mass = model.gridpoints.mass[gridpoint];
    return mass > 0 ? model.gridpoints.inertial_mass[gridpoint] / mass : 1;
}

/// The reaction of prescribed components: it balances all other forces.
Vec3 reaction(const Model& model, Row row) {
    const auto& g = model.gridpoints;
    Vec3 force = Vec3::Zero();
    if (!model.blocks.deformable[g.block[row]]) return force;
    const Vec3 acting = unbalanced_at_gridpoint(model, row);
    for (int k = 0; k < 3; ++k)
        if (g.fixed[row] & (1 << k)) force[k] = -acting[k];
    if (g.roller[row] != 0)
        force += roller_change(model.rollers[static_cast<std::size_t>(g.roller[row])], acting + force, g.fixed[row],
                               Vec3::Zero());
    return force;
}

FieldValue group(const Model& model, Row gridpoint) {
    return find_field(ObjectKind::block, "group")->get(model, model.gridpoints.block[gridpoint]);
}

} // namespace

const Fields& gridpoint_fields() {
    static const Fields rows{
        {table, "id", "gp_id", "block.gp.id", "-", "number, from 1; changes when blocks are deleted",
         call<count_from_one>, nullptr},
        {table, "block", "gp_block", "block.gp.hostblock", "-", "block that it belongs to",
         link<rows_of, &Gridpoints::block, ObjectKind::block>, nullptr},
        {table, "position", "gp_pos", "block.gp.pos", "length", "where it is now", read<rows_of, &Gridpoints::position>,
         nullptr},
        {table, "x", "gp_x", "block.gp.pos.x", "length", "x", read<rows_of, &Gridpoints::position, 0>, nullptr},
        {table, "y", "gp_y", "block.gp.pos.y", "length", "y", read<rows_of, &Gridpoints::position, 1>, nullptr},
        {table, "z", "gp_z", "block.gp.pos.z", "length", "z", read<rows_of, &Gridpoints::position, 2>, nullptr},
        {table, "mass", "gp_mass", "block.gp.mass", "mass", "mass, 0 before the first cycle",
         read<rows_of, &Gridpoints::mass>, nullptr},
        {table, "density_scaling", "gp_dsf", "block.gp.dsf", "-", "mass in the equation of motion over true mass",
         call<density_scaling>, nullptr},
        {table, "group", "gp_group", "block.gp.group", "-", "group of its block", group, nullptr},
        {table, "fixed", "", "", "-", "sum of 1, 2, 4 for x, y, z velocities that are prescribed",
         read<rows_of, &Gridpoints::fixed>, nullptr},
        {table, "velocity", "gp_vel", "block.gp.vel", "length/time", "velocity", call<gridpoint_velocity>,
         set_vector<velocity_to_set>},
        {table, "x_velocity", "gp_xvel", "block.gp.vel.x", "length/time", "x velocity", call<gridpoint_velocity, 0>,
         set_component<velocity_to_set, 0>},
        {table, "y_velocity", "gp_yvel", "block.gp.vel.y", "length/time", "y velocity", call<gridpoint_velocity, 1>,
         set_component<velocity_to_set, 1>},
        {table, "z_velocity", "gp_zvel", "block.gp.vel.z", "length/time", "z velocity", call<gridpoint_velocity, 2>,
         set_component<velocity_to_set, 2>},
        {table, "displacement", "gp_dis", "block.gp.disp", "length", "displacement",
         read<rows_of, &Gridpoints::displacement>, write<rows_of, &Gridpoints::displacement>},
        {table, "x_displacement", "gp_xdis", "block.gp.disp.x", "length", "x displacement",
         read<rows_of, &Gridpoints::displacement, 0>, write<rows_of, &Gridpoints::displacement, 0>},
        {table, "y_displacement", "gp_ydis", "block.gp.disp.y", "length", "y displacement",
         read<rows_of, &Gridpoints::displacement, 1>, write<rows_of, &Gridpoints::displacement, 1>},
        {table, "z_displacement", "gp_zdis", "block.gp.disp.z", "length", "z displacement",
         read<rows_of, &Gridpoints::displacement, 2>, write<rows_of, &Gridpoints::displacement, 2>},
        {table, "force", "gp_force", "block.gp.force.unbal", "force",
         "unbalanced force of the last cycle, with loads and weight", call<unbalanced_at_gridpoint>, nullptr},
        {table, "x_force", "gp_xforce", "block.gp.force.unbal.x", "force", "x unbalanced force",
         call<unbalanced_at_gridpoint, 0>, nullptr},
        {table, "y_force", "gp_yforce", "block.gp.force.unbal.y", "force", "y unbalanced force",
         call<unbalanced_at_gridpoint, 1>, nullptr},
        {table, "z_force", "gp_zforce", "block.gp.force.unbal.z", "force", "z unbalanced force",
         call<unbalanced_at_gridpoint, 2>, nullptr},
        {table, "reaction", "gp_reaction", "block.gp.force.reaction", "force",
         "force that holds what is prescribed of its velocity, of deformable blocks", call<reaction>, nullptr},
        {table, "x_reaction", "gp_xreaction", "block.gp.force.reaction.x", "force", "x reaction", call<reaction, 0>,
         nullptr},
        {table, "y_reaction", "gp_yreaction", "block.gp.force.reaction.y", "force", "y reaction", call<reaction, 1>,
         nullptr},
        {table, "z_reaction", "gp_zreaction", "block.gp.force.reaction.z", "force", "z reaction", call<reaction, 2>,
         nullptr},
        {table, "pore_pressure", "gp_pp", "block.gp.pp", "stress", "pore pressure given by initialize pp or insitu pp",
         read<rows_of, &Gridpoints::pore_pressure>, set_pore_pressure},
        {table, "load", "gp_load", "block.gp.force.app", "force", "applied force", read<rows_of, &Gridpoints::load>,
         set_vector<load_to_set>},
        {table, "x_load", "gp_xload", "block.gp.force.app.x", "force", "x applied force",
         read<rows_of, &Gridpoints::load, 0>, set_component<load_to_set, 0>},
        {table, "y_load", "gp_yload", "block.gp.force.app.y", "force", "y applied force",
         read<rows_of, &Gridpoints::load, 1>, set_component<load_to_set, 1>},
        {table, "z_load", "gp_zload", "block.gp.force.app.z", "force", "z applied force",
         read<rows_of, &Gridpoints::load, 2>, set_component<load_to_set, 2>},
    };
    return rows;
}

} // namespace kaya::field_rows
