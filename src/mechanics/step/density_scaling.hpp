// Density scaling of masses: docs/theory/time-step.md.
// reads: blocks.mass, gridpoints.mass, structures.member_nodes, settings.mass_scaling, clock.time_step
// writes: blocks.inertial_mass, blocks.velocity, blocks.rotational_velocity, blocks.angular_momentum, gridpoints.inertial_mass, gridpoints.velocity, structures.member_nodes, energy
#pragma once

#include "model/tables/model.hpp"

#include <cstddef>

namespace kaya {

struct BodyStiffness;

struct ScaledMasses {
    std::size_t bodies = 0;        ///< rigid blocks and gridpoints that have mass and may move
    std::size_t scaled = 0;        ///< of them those with an inertial mass that differs from their own
    double real = 0, inertial = 0; ///< sums over those bodies
};

ScaledMasses scaled_masses(const Model& model);

/// Sets inertial masses so that `stable_step` is stable for every body, none below `least` times its mass. Velocities stay. Masses that
/// suffice and are not much too large stay too.
void scale_masses(Model& model, const BodyStiffness& stiffness, double stable_step, double least);

/// The same, only upwards from the present masses: for stiffnesses that grow between two scalings. False where all suffice.
bool raise_masses(Model& model, const BodyStiffness& stiffness, double stable_step);

/// Sets all inertial masses to the true ones.
void restore_masses(Model& model);

/// The step at which full density scaling leaves the total mass unchanged; 0 without stiffness.
double mean_stable_step(const Model& model, const BodyStiffness& stiffness);

/// The largest step that is stable for every body with its present inertial mass; infinite without stiffness.
double least_stable_step(const Model& model, const BodyStiffness& stiffness);

/// Inertial masses and moments of inertia of free nodes of beams and liners for the present step: equation (15) of
/// docs/theory/beams-and-liners.md.
void fit_member_masses(Model& model);

} // namespace kaya
