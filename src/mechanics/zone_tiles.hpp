// The zones in tiles of one law each, and who shares the gridpoints of a tile; derived.
#pragma once

#include "mechanics/adjacency.hpp"
#include "model/model.hpp"

#include <array>
#include <functional>
#include <vector>

namespace kaya {

/// What a tile has at most: its gridpoints and what a law sees of it stay near the processor. The zones are whole groups of eight, and of
/// eight cells.
constexpr Row most_zones_in_tile = 1008, most_points_in_tile = 1024;

/// A vector at a point of a tile, and what goes with it.
struct alignas(32) PointRow {
    std::array<double, 4> value;
};

/// Rows [first, last) of the zones, and their gridpoints.
struct ZoneTile {
    Row first, last;
    std::size_t law;
    Span points; ///< in ZoneTiles::gridpoints
};

/// A point of a tile is a gridpoint as that tile sees it: one task writes to it. A gridpoint between tiles of its block is
/// a point of each of them.
class ZoneTiles {
public:
    ZoneTiles() = default;
    /// `law_of` gives the law of a zone; as many zones as `together` gives for a law stay in one tile.
    ZoneTiles(
        const Model& model, const std::function<std::size_t(Row zone)>& law_of,
        const std::function<Row(std::size_t law)>& together = [](std::size_t) { return 1; });

    std::vector<ZoneTile> tiles;
    std::vector<Row> gridpoints;             ///< of each point, tile after tile
    std::vector<std::array<Row, 4>> corners; ///< of each zone: points, counted from the first of its tile
    std::vector<std::uint8_t> ruled;         ///< by zone; the first of a cell has bits of its faces, see RuledFaces
    Lists<Row> points_of;                    ///< of each gridpoint, in the order of the tiles
};

} // namespace kaya
