// Cells of the meshes of other programs as tetrahedra, and the blocks that connected cells make. Private to geometry.
#pragma once

#include "geometry/grid/grid3d.hpp"

#include <functional>
#include <span>

namespace kaya {

/// Corners are in the order of gmsh and VTK: around the base, then around the top, or the tip.
enum class CellKind { tetrahedron, pyramid, wedge, hexahedron };

std::size_t corners_of(CellKind kind);
std::string_view name_of(CellKind kind);

/// Zones that the file puts together.
struct ZoneSet {
    std::string group;
    int region = 0, material = 0; ///< of its blocks; 0: none
    std::vector<int> zones;
};

/// Throws Diagnostic with the present place in the file.
using FailHere = std::function<void(const std::string& message, const std::string& hint)>;

/// Divides a cell into zones and adds them. All faces are cut through the corner with the lowest number, and so from both sides in the same
/// way (Dompierre et al. 1999, How to subdivide pyramids, prisms and hexahedra into tetrahedra). Fails when the cell has
/// no volume or is turned inside out in part.
void add_cell(Grid3d& grid, ZoneSet& set, const FailHere& fail, CellKind kind, long long number,
              std::span<const int> corners);

/// Zones of a set that hang together by faces become a block.
void make_blocks(Grid3d& grid, const ZoneSet& set);

} // namespace kaya
