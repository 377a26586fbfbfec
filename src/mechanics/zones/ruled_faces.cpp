#include "mechanics/zones/ruled_faces.hpp"

#include "mechanics/common/row_lists.hpp"
#include "mechanics/zones/tile_rows.hpp"

#include <algorithm>
#include <numeric>

namespace kaya {

namespace {

/// Corners of the faces of a cell, in the order of RuledFaces.
constexpr std::size_t corners_of_face[6][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3},
                                               {1, 3, 5, 7}, {2, 3, 6, 7}, {4, 5, 6, 7}};

struct CellFace {
    Row zone;                ///< the first of the cell
    std::uint32_t cell : 29; ///< as ZoneTile counts
    std::uint32_t face : 3;
};

/// For each gridpoint the first of its group, else itself.
std::vector<Row> leaders(const Model& model, const TieLists& ties) {
    std::vector<Row> leader(model.gridpoints.size());
    std::iota(leader.begin(), leader.end(), Row{0});
    for (std::size_t group = 0; group < ties.groups(); ++group)
        for (const Row g : ties.members(group)) leader[g] = ties.members(group).front();
    return leader;
}

/// Ascending; of a group of tied gridpoints the first.
std::array<Row, 4> corners_of(const Model& model, const std::vector<Row>& leader, const CellFace& f) {
    const std::array<Row, 8> cell = corners_of_cell(&model.zones.gridpoints[f.zone]);
    std::array<Row, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = leader[cell[corners_of_face[f.face][k]]];
    std::ranges::sort(corners);
    return corners;
}

} // namespace

void find_ruled_faces(const Model& model, const TieLists& ties, ZoneLaws& laws) {
    auto& ruled = laws.tiles.ruled;
    const std::vector<Row> leader = leaders(model, ties);
    // By their first corner: few share one.
    const auto faces = sorted_lists<CellFace>(model.gridpoints.size(), [&](auto add) {
        for (const ZoneTile& tile : laws.tiles.tiles) {
            if (!by_cells(laws.laws[tile.law].together)) continue;
            for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell)
                for (std::uint32_t f = 0; f < 6; ++f) {
                    const CellFace face{zone, static_cast<std::uint32_t>(tile.cell(zone)), f};
                    add(corners_of(model, leader, face).front(), face);
                }
        }
    });
    const auto rule = [&](const CellFace& f) { ruled[f.cell] |= static_cast<std::uint8_t>(1 << f.face); };
    for (Row g = 0; g < static_cast<Row>(model.gridpoints.size()); ++g)
        for (auto face = faces.begin(g); face != faces.end(g); ++face)
            for (auto other = face + 1; other != faces.end(g); ++other)
                if (corners_of(model, leader, *face) == corners_of(model, leader, *other)) {
                    rule(*face);
                    rule(*other);
                }
}

} // namespace kaya
