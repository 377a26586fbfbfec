// Conditions on faces of deformable blocks: quiet boundaries and velocities along normals.
#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

/// Makes those of the triangles quiet that belong to deformable blocks; `bits` of Quiet are added to what was there.
/// Returns how many there were.
std::size_t make_quiet(Model& model, const std::vector<Row>& triangles, std::uint8_t bits);

/// Holds the velocity of gridpoints of deformable blocks along the outward normals of the triangles' faces. A gridpoint
/// on faces that look in different directions is held along each. What was held in the same direction before is
/// replaced. Returns how many gridpoints are held.
std::size_t hold_normals(Model& model, const std::vector<Row>& triangles, double speed);

/// Takes quiet boundaries off the axes given from triangles whose gridpoints are all listed (sorted rows); with all three
/// axes also those of normal and shear velocity, and rollers from the gridpoints.
void free_faces(Model& model, const std::vector<Row>& gridpoints, std::uint8_t axes);

} // namespace kaya
