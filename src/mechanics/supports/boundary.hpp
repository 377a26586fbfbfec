// Boundary conditions and loads on gridpoints, blocks and faces.
#pragma once

#include "model/tables/model.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace kaya {

/// The row of this function in Model::time_functions; added when absent.
std::int32_t time_function_row(Model& model, const TimeFunction& function);

/// Components of motion of a body: x, y, z of its translation, and of a rigid block's rotation.
inline constexpr int components = 6;

/// Whole blocks, and single gridpoints of deformable blocks.
struct Bodies {
    std::vector<Row> blocks;
    std::vector<Row> gridpoints;
    bool empty() const { return blocks.empty() && gridpoints.empty(); }
};

/// Prescribes a velocity component, `value` times the function; for a whole deformable block at all its gridpoints, so it has no rotation.
/// Replaces an earlier prescription of the same component.
void prescribe_velocity(Model& model, const Bodies& bodies, int component, double value,
                        std::int32_t function = constant_in_time);

/// Frees a component.
void release_velocity(Model& model, const Bodies& bodies, int component);

/// Frees held components and applies loads that balance the forces of the last cycle, so the model stays at rest. Forces and masses must be
/// current: Cycle::prepare.
void replace_by_reaction(Model& model, const Bodies& bodies, int axis);

/// Sets the initial velocity of a component; prescribed components are left unchanged. Throws Diagnostic for the rotation of a block of
/// unknown density.
void initialize_velocity(Model& model, const Bodies& bodies, int component, double value);

/// Sets the displacement from which counting continues; the body does not move.
void initialize_displacement(Model& model, const Bodies& bodies, int axis, double value);

/// Adds a force to each gridpoint. At a vertex of a rigid block it moves with the vertex and keeps its direction.
void add_load(Model& model, const std::vector<Row>& gridpoints, int axis, double value,
              std::int32_t function = constant_in_time);

/// Adds a force through the centroid or a moment to rigid blocks.
void add_block_load(Model& model, const std::vector<Row>& blocks, int component, double value,
                    std::int32_t function = constant_in_time);

/// Adds a force at a point of a rigid block; the point moves with the block, the direction stays.
void add_load_at(Model& model, Row block, const Vec3& place, const Vec3& force,
                 std::int32_t function = constant_in_time);

/// A stress that is linear in position; the six components are xx yy zz xy xz yz.
struct StressField {
    Stress at_origin = Stress::Zero();
    std::array<Stress, 3> gradient{Stress::Zero(), Stress::Zero(), Stress::Zero()};
    Stress at(const Vec3& place) const;
};

/// Triangles with all three gridpoints in the list (sorted rows) that other blocks do not cover whole, nor by more than a part of their area
/// (model/measure/covered_faces.hpp). Contacts must be up to date. Ascending rows.
std::vector<Row> exterior_triangles(const Model& model, const std::vector<Row>& gridpoints, double most_covered = 1);
/// The exterior triangles of faces in the list (sorted rows).
std::vector<Row> exterior_triangles_of_faces(const Model& model, const std::vector<Row>& faces,
                                             double most_covered = 1);

/// Adds the tractions of a stress to exterior triangles (ascending rows), or to those with all three gridpoints in the list (sorted rows). What
/// another block covers is not exterior, with a joint or joined to it. The two triangles of an outer face of a cell are loaded as the mean of
/// both diagonals. Contacts must be up to date. Returns the loaded area.
double add_stress_on(Model& model, const std::vector<Row>& triangles, const StressField& stress,
                     std::int32_t function = constant_in_time);
double add_stress(Model& model, const std::vector<Row>& gridpoints, const StressField& stress,
                  std::int32_t function = constant_in_time);

/// Splits velocity histories of blocks that have got zones into one per gridpoint, so that single ones can be removed; drops histories of
/// deleted blocks and whole-block loads of blocks that have got zones.
void tidy_boundary_histories(Model& model);

/// Fixes or frees components of whole blocks: `which` is a sum of Fixity bits.
void fix_blocks(Model& model, const std::vector<Row>& blocks, std::uint8_t which = fix_all);
void free_blocks(Model& model, const std::vector<Row>& blocks, std::uint8_t which = fix_all);

} // namespace kaya
