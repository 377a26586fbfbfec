// What density scaling does to masses: docs/theory/time-step.md.
// reads: blocks.mass, gridpoints.mass, structures.member_nodes, settings.mass_scaling, clock.time_step
// writes: blocks.inertial_mass, blocks.velocity, blocks.rotational_velocity, blocks.angular_momentum, gridpoints.inertial_mass, gridpoints.velocity, structures.member_nodes, energy
#pragma once

#include "model/model.hpp"

#include <cstddef>

namespace kaya {

struct BodyStiffness;

struct ScaledMasses {
    std::size_t bodies = 0;        ///< rigid blocks and gridpoints that have mass and may move
    std::size_t scaled = 0;        ///< of them with another inertial mass than their own
    double real = 0, inertial = 0; ///< sums over those bodies
};

ScaledMasses scaled_masses(const Model& model);

/// Gives inertial masses so that `stable_step` is the largest that is stable for every body, none below `least` times its
/// mass. Velocities stay. Masses that are enough and not much too large stay as well.
void scale_masses(Model& model, const BodyStiffness& stiffness, double stable_step, double least);

/// The same, only upwards from what the masses are: for stiffnesses that grow between two scalings.
void raise_masses(Model& model, const BodyStiffness& stiffness, double stable_step);

/// All inertial masses are the true ones again.
void restore_masses(Model& model);

/// The step at which full density scaling leaves the sum of all masses as it is; 0 when nothing resists.
double mean_stable_step(const Model& model, const BodyStiffness& stiffness);

/// Inertial masses and moments of inertia of the nodes of beams and liners that move by themselves, for a step as long as the model's now:
/// equation (15) of docs/theory/beams-and-liners.md.
void fit_member_masses(Model& model);

} // namespace kaya
