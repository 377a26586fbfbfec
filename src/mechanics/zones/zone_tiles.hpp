// The zones in tiles of one law each, and the tiles that share gridpoints; derived data.
#pragma once

#include "mechanics/bodies/adjacency.hpp"
#include "model/measure/cell_corners.hpp"
#include "model/tables/model.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace kaya {

/// Largest numbers in a tile: its gridpoints and the columns of a law stay in the processor's cache. The zones are whole groups of eight,
/// and of eight cells.
constexpr Row most_zones_in_tile = 1008, most_points_in_tile = 1024;

/// A vector at a point of a tile, and a fourth number.
struct alignas(32) PointRow {
    std::array<double, 4> value;
};

/// A point of a tile, counted from its first.
using TilePoint = std::uint16_t;
static_assert(most_points_in_tile <= std::numeric_limits<TilePoint>::max());

/// The corners of a zone, and of a cell: corner i + 2 j + 4 k is at the ends i, j, k of the three axes of its cell.
using ZoneCorners = std::array<TilePoint, 4>;
using CellCorners = std::array<TilePoint, 8>;

constexpr Row cells_of_group = 8; ///< cells that are worked on together
constexpr Row zones_of_group = zones_of_cell * cells_of_group;

/// Rows [first, last) of the zones, and their gridpoints.
struct ZoneTile {
    Row first, last;
    std::size_t law;
    Span points; ///< in ZoneTiles::gridpoints
    bool has_cells = false;
    Row first_group = 0; ///< of its cells

    /// The group of a zone that is the first of one.
    Row group(Row zone) const { return first_group + (zone - first) / zones_of_group; }
    /// The place of a cell by its first zone, counted in whole groups.
    Row cell(Row zone) const { return first_group * cells_of_group + (zone - first) / zones_of_cell; }
};

/// An outer face of a cell whose zones act one by one.
struct SharedFace {
    /// Gridpoints, as corners_of_face has them: the zones have the diagonal from the second to the last.
    std::array<Row, 4> corners;
    std::array<Row, 2> zones; ///< those at the first corner and at the third
};

/// A point of a tile is the gridpoint in that tile: only one task writes to it. A gridpoint between tiles of its block is a point of each
/// of them.
class ZoneTiles {
public:
    ZoneTiles() = default;
    /// `law_of` returns the law of a zone; groups of as many zones as `together` returns for a law stay in one tile.
    ZoneTiles(
        const Model& model, const std::function<std::size_t(Row zone)>& law_of,
        const std::function<Row(std::size_t law)>& together = [](std::size_t) { return 1; });

    std::vector<ZoneTile> tiles;
    std::vector<Row> gridpoints;      ///< of each point, tile after tile
    std::vector<ZoneCorners> corners; ///< of each zone
    Lists<Row> points_of;             ///< of each gridpoint, in the order of the tiles

    // Corners of cells, group after group; the last group of a tile is filled up with its last cell.
    std::vector<CellCorners> cells;
    std::vector<std::uint8_t> ruled;      ///< bits of faces, see RuledFaces
    std::vector<SharedFace> shared_faces; ///< see shared_faces.hpp
    std::vector<std::uint8_t> outer;      ///< bits of the ruled faces that no other cell shares
    Row groups() const { return static_cast<Row>(cells.size()) / cells_of_group; }

private:
    void add_cells(ZoneTile& tile);
};

} // namespace kaya
