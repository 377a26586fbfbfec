// Conditions on faces of deformable blocks: quiet boundaries and velocities along normals.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

/// Makes the given triangles of deformable blocks quiet; adds `bits` of Quiet. Returns their number.
std::size_t make_quiet(Model& model, const std::vector<Row>& triangles, std::uint8_t bits);

/// Holds the velocity of gridpoints of deformable blocks along the outward normals of the triangles' faces. A gridpoint on faces with
/// different normals is held along each. An earlier hold in the same direction is replaced. Returns the number of held gridpoints.
std::size_t hold_normals(Model& model, const std::vector<Row>& triangles, double speed);

/// Removes quiet boundaries along the given axes from triangles with all gridpoints listed (sorted rows); with all three axes also quiet
/// boundaries of normal and shear velocity, and rollers of the gridpoints.
void free_faces(Model& model, const std::vector<Row>& gridpoints, std::uint8_t axes);

} // namespace kaya
