// Which blocks are cut in cells, and how, so that cells of neighbours meet. Private to geometry.
#pragma once

#include "geometry/polyhedron.hpp"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace kaya {

/// An edge that blocks share: the numbers of its two ends, the lower one first.
using SharedEdge = std::array<int, 2>;

/// Into how many parts an edge of that length is divided, at least 1.
int parts_of(double length, double edge);

/// The grid of a block.
struct CellBlock {
    std::array<int, 8> corner; ///< as hexahedron_corners; cells' long diagonals go from corner 0 to corner 7
    std::array<int, 3> parts;
};

/// Grids for the blocks with six faces of four corners, other places of the result are empty. Edges that lie opposite each other in a face of such a block
/// are divided alike and have one direction, and so are those opposite of these in the next block, and on: their mean length
/// says in how many parts, the lowest of them the direction. Diagonals of faces go from where both directions begin to where
/// both end, so they are the same on both sides. `numbers` are those of the blocks' vertices, `given` the parts
/// of edges that are divided already.
std::vector<std::optional<CellBlock>> cell_blocks(const std::vector<Polyhedron>& blocks,
                                                  const std::vector<std::vector<int>>& numbers,
                                                  const std::map<SharedEdge, int>& given, double edge);

} // namespace kaya
