// Making and removing rows of the model: blocks and the zones in them.
#pragma once

#include "geometry/polyhedron.hpp"
#include "model/model.hpp"

namespace kaya {

struct NewBlock {
    std::int32_t material = 1, constitutive = 1, region = 0, group = 0;
};

/// Adds a rigid block; its number is the next one. Returns its row.
Row add_block(Model& model, const Polyhedron& polyhedron, const NewBlock& options);

/// The block's current shape (vertices where they are now).
Polyhedron shape_of(const Model& model, Row block);

/// Removes blocks with all that belongs to them; contacts are made anew before the next cycle.
void delete_blocks(Model& model, const std::vector<Row>& blocks);

/// A conforming mesh of tetrahedra of average edge `edge` in each of the blocks that has none; they
/// become deformable. Returns how many blocks were zoned. Throws Diagnostic, model unchanged.
std::size_t generate_zones(Model& model, const std::vector<Row>& blocks, double edge);

} // namespace kaya
