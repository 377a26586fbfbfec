// Boundary conditions and loads on gridpoints, blocks and faces.
#pragma once

#include "model/model.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace kaya {

/// Of what is not multiplied by a function of time.
inline constexpr std::int32_t constant_in_time = -1;

/// The row of an equal function in Model::time_functions, which is added when there is none.
std::int32_t time_function_row(Model& model, const TimeFunction& function);

/// Components of motion of a body: x, y, z of its translation, and of a rigid block's rotation.
inline constexpr int components = 6;

/// Whole blocks, and single gridpoints of deformable blocks.
struct Bodies {
    std::vector<Row> blocks;
    std::vector<Row> gridpoints;
    bool empty() const { return blocks.empty() && gridpoints.empty(); }
};

/// Prescribes a velocity component, `value` times the function; a whole block that is deformable gets it at all its
/// gridpoints, and so it has no rotation. Replaces what was prescribed for the same component before.
void prescribe_velocity(Model& model, const Bodies& bodies, int component, double value,
                        std::int32_t function = constant_in_time);

/// Lets a component move again.
void release_velocity(Model& model, const Bodies& bodies, int component);

/// Lets held components move again and puts a load on them that balances the forces of the last cycle, so that nothing
/// starts to move. Forces and masses must be those of the present: Cycle::prepare.
void replace_by_reaction(Model& model, const Bodies& bodies, int axis);

/// Gives a component a velocity to start with; one that is prescribed keeps its own.
/// Throws Diagnostic for the rotation of a block whose density is not known.
void initialize_velocity(Model& model, const Bodies& bodies, int component, double value);

/// Sets the displacement that is counted from now on; nothing moves.
void initialize_displacement(Model& model, const Bodies& bodies, int axis, double value);

/// Adds a force to every gridpoint given. On a rigid block's vertex it goes with the vertex and keeps its direction.
void add_load(Model& model, const std::vector<Row>& gridpoints, int axis, double value,
              std::int32_t function = constant_in_time);

/// Adds a force through the centroid or a moment to rigid blocks.
void add_block_load(Model& model, const std::vector<Row>& blocks, int component, double value,
                    std::int32_t function = constant_in_time);

/// Adds a force at a place of a rigid block, with which it goes; its direction stays.
void add_load_at(Model& model, Row block, const Vec3& place, const Vec3& force,
                 std::int32_t function = constant_in_time);

/// Stress that varies linearly from the origin; the six components xx yy zz xy xz yz each.
struct StressField {
    Stress at_origin = Stress::Zero();
    std::array<Stress, 3> gradient{Stress::Zero(), Stress::Zero(), Stress::Zero()};
    Stress at(const Vec3& place) const;
};

/// Triangles whose three gridpoints are all in the list (sorted rows), on faces on which no other block lies. Contacts
/// must have been found. Ascending rows.
std::vector<Row> exterior_triangles(const Model& model, const std::vector<Row>& gridpoints);

/// Adds the tractions of a stress to the exterior triangles whose three gridpoints are all in the list
/// (sorted rows); a face on which another block lies is not exterior, nor is the part of a rigid block's face that lies
/// on another block of the same body. Contacts must have been found. Returns the loaded area.
double add_stress(Model& model, const std::vector<Row>& gridpoints, const StressField& stress,
                  std::int32_t function = constant_in_time);

/// Fixes or frees components of whole blocks: `which` is a sum of Fixity bits.
void fix_blocks(Model& model, const std::vector<Row>& blocks, std::uint8_t which = fix_all);
void free_blocks(Model& model, const std::vector<Row>& blocks, std::uint8_t which = fix_all);

} // namespace kaya
