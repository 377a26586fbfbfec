// Cells of the meshes of other programs as tetrahedra, and the blocks that connected cells make. Private to geometry.
#pragma once

#include "geometry/grid/grid3d.hpp"
#include "geometry/read/words.hpp"

#include <span>

namespace kaya {

/// Corners are in the order of gmsh and VTK: around the base, then around the top, or the tip.
enum class CellKind { tetrahedron, pyramid, wedge, hexahedron };

std::size_t corners_of(CellKind kind);
std::string_view name_of(CellKind kind);

/// Zones that the file puts together.
struct ZoneSet {
    std::string group;
    int number = 0; ///< region and material of its blocks; 0: none
    std::vector<int> zones;
};

/// Divides a cell into zones and adds them. All faces are cut through the corner with the lowest number, and so from both sides in the same
/// way (Dompierre et al. 1999, How to subdivide pyramids, prisms and hexahedra into tetrahedra). Fails at the present line when the cell has
/// no volume or is turned inside out in part.
void add_cell(Grid3d& grid, ZoneSet& set, const Words& words, CellKind kind, long long number,
              std::span<const int> corners);

/// Zones of a set that hang together by faces become a block.
void make_blocks(Grid3d& grid, const ZoneSet& set);

} // namespace kaya
