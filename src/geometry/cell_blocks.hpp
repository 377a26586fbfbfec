// Which blocks are cut in cells, and how, so that cells of neighbours meet. Private to geometry.
#pragma once

#include "geometry/edge_classes.hpp"
#include "geometry/hexahedron.hpp"
#include "geometry/polyhedron.hpp"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace kaya {

/// The grid of a block.
struct CellBlock {
    std::array<int, 8> corner; ///< as hexahedron_corners; cells' long diagonals go from corner 0 to corner 7
    GridPlaces places;
};

/// Grids for the blocks with six faces of four corners, other places of the result are empty. Edges that lie opposite each other in a face of such a block
/// are divided alike and have one direction, and so are those opposite of these in the next block, and on, as long as that leaves cells near
/// the size that is asked for: the mean of their parts says in how many, the lowest of them the direction, which goes on through a face to the next
/// block. Diagonals of faces go from where both directions begin to where both end, so they are the same on both sides; since directions go on,
/// gridpoints of a row have equal shares of the faces around them. `numbers` are those of the blocks' vertices, `given` the divisions of edges that
/// are divided already. What blocks get does not depend on their order.
std::vector<std::optional<CellBlock>> cell_blocks(const std::vector<Polyhedron>& blocks,
                                                  const std::vector<std::vector<int>>& numbers,
                                                  std::map<SharedEdge, std::vector<double>> given,
                                                  const EdgeField& field);

} // namespace kaya
