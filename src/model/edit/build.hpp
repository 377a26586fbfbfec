// Adds and removes rows of the model: blocks and the zones in them.
#pragma once

#include "base/progress_callback.hpp"
#include "geometry/mesh/edge_field.hpp"
#include "geometry/mesh/mesh.hpp"
#include "model/tables/model.hpp"

namespace kaya {

struct NewBlock {
    std::int32_t material = 1, constitutive = 1, region = 0, group = 0, zone_properties = 0;
};

/// Adds a rigid block; its number is the next one. Returns its row. Throws Diagnostic, model unchanged, when the
/// polyhedron has no volume.
Row add_block(Model& model, const Polyhedron& polyhedron, const NewBlock& options);

/// Adds a solid of convex parts, joined if there are several. Returns the row of the first.
Row add_solid(Model& model, const std::vector<Polyhedron>& parts, const NewBlock& options);

/// A new row of the table of blocks, with a number and an id and nothing else. Returns it.
Row add_block_row(Model& model);

/// Gives a rigid block a shape of positive volume: mass properties, vertices, faces; its motion is set already. New rows are at the ends of
/// their tables; unless the block is the last one, they are out of order until put_in_block_order.
void give_shape(Model& model, Row block, const Polyhedron& polyhedron);
/// The same where mass_properties() of the polyhedron is known.
void give_shape(Model& model, Row block, const Polyhedron& polyhedron, const MassProperties& mass);

/// Replaces the surface and the gridpoints of a block by those of a mesh of its shape and adds the zones. New rows are at the ends of their
/// tables and out of order until put_in_block_order.
void give_zones(Model& model, Row block, const Polyhedron& shape, const TetMesh& mesh);

/// Sorts the rows of gridpoints, faces, triangles and zones by block and drops those without a block. The spans of `blocks` define the
/// owners.
void put_in_block_order(Model& model);

/// The block's current shape (vertices where they are now).
Polyhedron shape_of(const Model& model, Row block);

/// Removes blocks with all their parts; contacts are rebuilt before the next cycle. The rest of a joined body stays joined where its parts
/// are in contact.
void delete_blocks(Model& model, const std::vector<Row>& blocks);

/// Meshes each rigid block conformingly with tetrahedra, edge lengths given by the field; the blocks become deformable. Returns the number
/// of meshed blocks. Throws Diagnostic and leaves the model unchanged.
std::size_t generate_zones(Model& model, const std::vector<Row>& blocks, const EdgeField& field,
                           const ProgressCallback& progress = {});

/// The same with six tetrahedra in each of so many cells along the axes of blocks with six faces of four corners: hexahedron_mesh.
std::size_t generate_zones(Model& model, const std::vector<Row>& blocks, const std::array<int, 3>& parts,
                           const std::array<double, 3>& ratio, const ProgressCallback& progress = {});

} // namespace kaya
