// Which blocks are cut in cells, and how, so that cells of neighbours meet. Private to geometry.
#pragma once

#include "geometry/mesh/edge_classes.hpp"
#include "geometry/mesh/hexahedron.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include <array>
#include <map>
#include <optional>
#include <vector>

namespace kaya {

/// The grid of a block.
struct CellBlock {
    std::array<int, 8> corner; ///< as hexahedron_corners; long diagonals of cells run from corner 0 to corner 7
    GridPlaces places;
};

/// Grids for the blocks with six faces of four corners; other entries of the result are empty. Opposite edges of a face of such a block
/// have equal divisions and one direction. So have the edges opposite to these in the next block, and so on, as long as the cells stay near
/// the requested size. The mean of their parts gives the number of divisions. The lowest edge gives the direction, which continues through a
/// face into the next block. Diagonals of faces run from the start of both directions to the end of both, so they are the same on both
/// sides. Since directions continue, gridpoints of a row have equal shares of the faces around them. `numbers` are those of the blocks' vertices,
/// `given` the divisions of edges that are divided already. The result does not depend on the order of the blocks.
std::vector<std::optional<CellBlock>> cell_blocks(const std::vector<Polyhedron>& blocks,
                                                  const std::vector<std::vector<int>>& numbers,
                                                  std::map<SharedEdge, std::vector<double>> given,
                                                  const EdgeField& field);

} // namespace kaya
