// Quantities of the whole model. The row argument of the getters is unused here.
#include "model/fields/field_rows.hpp"
#include "model/measure/rayleigh.hpp"
#include "model/measure/time_step_fraction.hpp"

#include <fmt/format.h>

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::global;

template <auto member> FieldValue clock(const Model& model, Row) { return value_of(model.clock.*member); }
template <auto member> FieldValue energy(const Model& model, Row) { return value_of(model.energy.*member); }
FieldValue energy_error(const Model& model, Row) { return model.energy.error(); }
template <auto member> FieldValue setting(const Model& model, Row) { return value_of(model.settings.*member); }
template <int k> FieldValue gravity(const Model& model, Row) { return model.settings.gravity[k]; }
template <int k> void set_gravity(Model& model, Row, const FieldValue& value) {
    model.settings.gravity[k] = number(value);
}
void set_gravity_vector(Model& model, Row, const FieldValue& value) { model.settings.gravity = vector(value); }
FieldValue fraction(const Model& model, Row) { return time_step_fraction(model.settings); }
void set_fraction(Model& model, Row, const FieldValue& value) {
    const double part = number(value);
    if (!(part > 0 && part <= 1))
        throw Diagnostic(fmt::format("the time step cannot be {} of the largest stable one", part),
                         "give a number above 0 and at most 1");
    model.settings.time_step_fraction = part;
    ModelEdit(model, Change::properties);
}

template <Damping style> FieldValue damped_by(const Model& model, Row) {
    return static_cast<std::int64_t>(model.settings.damping == style);
}

template <auto factor> FieldValue rayleigh(const Model& model, Row) { return factor(model.settings); }

template <auto rows> FieldValue count(const Model& model, Row) {
    return static_cast<std::int64_t>((model.*rows).size());
}
/// Objects that FISH lists begin with; null when there are none.
template <auto rows, ObjectKind to> FieldValue head(const Model& model, Row) {
    return Link{to, (model.*rows).empty() ? no_row : 0};
}

/// The block created last: new rows are at the end.
FieldValue last_block(const Model& model, Row) {
    return Link{ObjectKind::block, static_cast<Row>(model.blocks.size()) - 1};
}

} // namespace

const Fields& global_fields() {
    static const Fields rows{
        {table, "time", "time", "mech.time", "time", "model time", clock<&Clock::time>, nullptr},
        {table, "cycle", "cycle", "mech.cycle", "-", "cycles done so far", clock<&Clock::cycle>, nullptr},
        {table, "step", "step", "mech.step", "-", "the same as cycle", clock<&Clock::cycle>, nullptr},
        {table, "time_step", "tdel", "mech.timestep", "time", "time step, 0 until it is computed",
         clock<&Clock::time_step>, nullptr},
        {table, "unbalanced_force", "unbal", "mech.unbalanced", "force", "largest unbalanced force of the last cycle",
         clock<&Clock::unbalanced_force>, nullptr},
        {table, "average_ratio", "", "mech.ratio.avg", "-", "mean unbalanced force over mean acting force",
         clock<&Clock::average_ratio>, nullptr},
        {table, "maximum_ratio", "", "mech.ratio.max", "-", "largest unbalanced force over mean acting force",
         clock<&Clock::maximum_ratio>, nullptr},
        {table, "local_ratio", "", "mech.ratio.local", "-", "largest ratio of unbalanced to acting force of one body",
         clock<&Clock::local_ratio>, nullptr},
        {table, "factor_of_safety", "fos", "mech.safety.factor", "-",
         "found last by solve fos, limit equilibrium or list stability (then the least of the blocks); 0 when there was none",
         clock<&Clock::factor_of_safety>, nullptr},
        {table, "peak_load", "", "mech.peak.load", "-",
         "greatest load of the last solve control, of its rows at rest; a force where a boundary was driven; 0 when there was none",
         clock<&Clock::peak_load>, nullptr},
        {table, "peak_displacement", "", "mech.peak.displacement", "-",
         "displacement of the last solve control at its peak load; 0 when there was none",
         clock<&Clock::peak_displacement>, nullptr},
        {table, "global_viscosity", "", "", "1/time", "viscosity of adaptive global damping",
         clock<&Clock::global_viscosity>, nullptr},
        {table, "kinetic_energy", "", "", "energy", "of all blocks, half a step ago", energy<&Energy::kinetic>,
         nullptr},
        {table, "gravity_work", "", "", "energy", "done by gravity on the blocks", energy<&Energy::gravity>, nullptr},
        {table, "boundary_work", "", "", "energy", "done by loads and prescribed velocities on the blocks",
         energy<&Energy::boundary>, nullptr},
        {table, "damped_energy", "", "", "energy", "taken out by damping", energy<&Energy::damped>, nullptr},
        {table, "joint_work", "", "", "energy", "work on joints: stored or lost", energy<&Energy::joint_work>, nullptr},
        {table, "frictional_energy", "", "", "energy", "lost in slip and failure", energy<&Energy::joint_friction>,
         nullptr},
        {table, "touch_energy", "", "", "energy", "lost in contact updates", energy<&Energy::joint_lost>, nullptr},
        {table, "zone_work", "", "", "energy", "work on zones", energy<&Energy::zone_work>, nullptr},
        {table, "structure_work", "", "", "energy", "work on cables, beams and liners: stored or lost",
         energy<&Energy::structure_work>, nullptr},
        {table, "step_energy", "", "", "energy", "time-step changes", energy<&Energy::step_made>, nullptr},
        {table, "energy_error", "", "", "energy", "residual of the energy balance", energy_error, nullptr},
        {table, "gravity", "grav", "global.gravity", "acceleration", "gravity", setting<&Settings::gravity>,
         set_gravity_vector},
        {table, "x_gravity", "xgrav", "global.gravity.x", "acceleration", "x component of gravity", gravity<0>,
         set_gravity<0>},
        {table, "y_gravity", "ygrav", "global.gravity.y", "acceleration", "y component of gravity", gravity<1>,
         set_gravity<1>},
        {table, "z_gravity", "zgrav", "global.gravity.z", "acceleration", "z component of gravity", gravity<2>,
         set_gravity<2>},
        {table, "gravity_x", "grav_x", "", "acceleration", "the same as x_gravity", gravity<0>, set_gravity<0>},
        {table, "gravity_y", "grav_y", "", "acceleration", "the same as y_gravity", gravity<1>, set_gravity<1>},
        {table, "gravity_z", "grav_z", "", "acceleration", "the same as z_gravity", gravity<2>, set_gravity<2>},
        {table, "time_step_fraction", "fracb", "", "-", "time step as a fraction of the largest stable one", fraction,
         set_fraction},
        {table, "zone_time_step_fraction", "fracz", "", "-", "the same as time_step_fraction", fraction, set_fraction},
        {table, "globally_damped", "damp_auto", "", "-", "1 with adaptive global damping", damped_by<Damping::global>,
         nullptr},
        {table, "locally_damped", "damp_local", "", "-", "1 with local damping", damped_by<Damping::local>, nullptr},
        {table, "rayleigh_alpha", "damp_alpha", "", "1/time",
         "Rayleigh damping of the mass, 0 when that part does not act", rayleigh<mass_damping>, nullptr},
        {table, "rayleigh_beta", "damp_beta", "", "time",
         "Rayleigh damping of the stiffness, 0 when that part does not act", rayleigh<stiffness_damping>, nullptr},
        {table, "block_count", "nblock", "block.num", "-", "number of blocks", count<&Model::blocks>, nullptr},
        {table, "gridpoint_count", "", "block.gp.num", "-", "number of gridpoints and vertices",
         count<&Model::gridpoints>, nullptr},
        {table, "zone_count", "nzone", "block.zone.num", "-", "number of zones", count<&Model::zones>, nullptr},
        {table, "contact_count", "", "block.contact.num", "-", "number of contacts", count<&Model::contacts>, nullptr},
        {table, "sub_contact_count", "", "block.subcontact.num", "-", "number of sub-contacts",
         count<&Model::sub_contacts>, nullptr},
        {table, "first_block", "block_head", "", "-", "first block of the list that b_next walks",
         head<&Model::blocks, ObjectKind::block>, nullptr},
        {table, "last_block", "last_block", "", "-", "block that was made last, the last part of a concave one",
         last_block, nullptr},
        {table, "first_contact", "contact_head", "", "-", "first contact of the list that c_next walks",
         head<&Model::contacts, ObjectKind::contact>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
