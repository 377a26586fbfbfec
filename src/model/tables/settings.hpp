// Settings of the whole model, and its clock.
#pragma once

#include "base/vector.hpp"

#include <cstdint>

namespace kaya {

/// How motion is damped. Equations: docs/theory/damping.md.
enum class Damping : std::int32_t { none, local, global, combined, rayleigh };

/// Source of the water pressure in joints.
enum class Water : std::int32_t {
    none,   ///< SubContacts::pore_pressure is not changed
    table,  ///< hydrostatic below a plane
    field,  ///< linear in space
    points, ///< of the adjacent gridpoints, Gridpoints::pore_pressure
    ground  ///< hydrostatic below Model::water_ground
};

/// Density scaling: which bodies have another mass in the equation of motion than in their weight.
enum class MassScaling : std::int32_t {
    none,
    full,   ///< all, so that all allow the same step; for static solution
    partial ///< only bodies with a shorter stable step than Settings::scaled_time_step get more mass
};

struct Settings {
    Vec3 gravity = Vec3::Zero();
    Damping damping = Damping::local;
    double local_factor = 0.8;        ///< alpha of F_d = -alpha |F| sgn(v)
    double global_ratio = 0.5;        ///< wanted damping power over the rate of change of kinetic energy
    double rayleigh_fraction = 0;     ///< of critical damping, at
    double rayleigh_frequency = 0;    ///< cycles/time
    bool rayleigh_mass = true;        ///< the part that is proportional to mass acts
    bool rayleigh_stiffness = true;   ///< the part that is proportional to stiffness acts
    double strength_factor = 1;       ///< by which the strength of zones is divided; `solve fos` uses it
    bool mixed_discretisation = true; ///< tetrahedra average volume strain over neighbours: docs/theory/zones.md
    double contact_damping = 0;       ///< of critical damping, in a dashpot at every contact
    double time_step_fraction = 0;    ///< of the largest stable step; 0: by the damping, see time_step_fraction()
    double given_time_step = 0;       ///< 0: computed; below 0: as_3dec(), compatibility.hpp
    MassScaling mass_scaling = MassScaling::none;
    double scaled_time_step = 0; ///< of partial density scaling
    Water water = Water::none;
    double water_value = 0;              ///< of a table: density; of a field: pressure at the origin
    Vec3 water_origin = Vec3::Zero();    ///< of a table: a point of the plane
    Vec3 water_direction = Vec3::Zero(); ///< of a table: unit normal, upward; of a field: gradient
    bool dynamic = false;
    bool large_strain = true;
    bool energy = true; ///< keep the energy account
    /// Of cells: in models that earlier programs saved, see model/measure/cell_faces.hpp.
    bool triangular_outer_faces = false;
    std::int32_t default_joint_material = 1;     ///< `set jmatdf`
    std::int32_t default_joint_constitutive = 1; ///< `set jcondf`
    /// Row of Model::joint_properties for new contacts, after a `jmodel` command that reached all; -1: the
    /// two defaults above decide.
    std::int32_t default_properties = -1;
};

/// Numbers that the cycle carries from step to step.
struct Clock {
    double time = 0;
    std::int64_t cycle = 0;
    double time_step = 0;        ///< 0: not computed yet
    double last_step = 0;        ///< the step that led to the present positions; 0: none yet
    double global_viscosity = 0; ///< of adaptive global damping, 1/time
    double unbalanced_force = 0; ///< largest of the last cycle
    double average_ratio = 0, maximum_ratio = 0, local_ratio = 0; ///< docs/theory/motion.md
    double factor_of_safety = 0;                                  ///< of the last `solve fos`; 0: none yet
    double peak_load = 0, peak_displacement = 0; ///< of the last `solve control`; 0: no row at rest yet

    /// The length of the step before this one; velocities of a start belong to the middle of a step as long as this one.
    double step_before() const { return last_step > 0 ? last_step : time_step; }
    /// From the middle of the last step, the time of the velocities, to the middle of this one: the time during which forces act.
    double kick() const { return 0.5 * (step_before() + time_step); }
};

} // namespace kaya
