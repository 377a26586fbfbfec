// Boundary conditions and loads on gridpoints, blocks and faces.
#pragma once

#include "model/model.hpp"

#include <array>
#include <optional>
#include <vector>

namespace kaya {

/// Prescribes velocity components; gridpoints of rigid blocks prescribe it for their block.
void prescribe_velocity(Model& model, const std::vector<Row>& gridpoints, int axis, double value);

/// Lets components move again.
void release_velocity(Model& model, const std::vector<Row>& gridpoints, int axis);

/// Adds a force to every gridpoint given.
void add_load(Model& model, const std::vector<Row>& gridpoints, int axis, double value);

/// Stress that varies linearly from the origin; the six components xx yy zz xy xz yz each.
struct StressField {
    Stress at_origin = Stress::Zero();
    std::array<Stress, 3> gradient{Stress::Zero(), Stress::Zero(), Stress::Zero()};
    Stress at(const Vec3& place) const;
};

/// Adds the tractions of a stress to the exterior triangles whose three gridpoints are all in the list
/// (sorted rows); a face on which another block lies is not exterior. Contacts must have been found.
/// Returns the loaded area.
double add_stress(Model& model, const std::vector<Row>& gridpoints, const StressField& stress);

/// Fixes or frees all components of whole blocks.
void fix_blocks(Model& model, const std::vector<Row>& blocks);
void free_blocks(Model& model, const std::vector<Row>& blocks);

} // namespace kaya
