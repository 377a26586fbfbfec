// Masses of blocks and gridpoints.
// reads: materials, blocks.volume, zones.volume
// writes: blocks.mass, blocks.inertial_mass, gridpoints.mass, gridpoints.inertial_mass
#pragma once

#include "model/tables/model.hpp"

namespace kaya {

/// Of the material of a block, mass/length^3; NaN when it is not given.
double density_of(const Model& model, Row block);

/// Computes masses from densities. Throws Diagnostic when one is missing.
void compute_masses(Model& model);

} // namespace kaya
