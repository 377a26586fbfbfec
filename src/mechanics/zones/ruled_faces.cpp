#include "mechanics/zones/ruled_faces.hpp"

#include "mechanics/common/row_lists.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/cell_faces.hpp"

#include <algorithm>
#include <numeric>

namespace kaya {

namespace {

/// Corners of the faces of a cell, in the order of RuledFaces.
constexpr std::size_t corners_of_face_of_cell[6][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3},
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
std::array<Row, 4> led(const std::vector<Row>& leader, std::array<Row, 4> corners) {
    for (Row& g : corners) g = leader[g];
    std::ranges::sort(corners);
    return corners;
}

std::array<Row, 4> corners_of(const Model& model, const std::vector<Row>& leader, const CellFace& f) {
    const std::array<Row, 8> cell = corners_of_cell(&model.zones.gridpoints[f.zone]);
    std::array<Row, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = cell[corners_of_face_of_cell[f.face][k]];
    return led(leader, corners);
}

std::uint8_t bit_of(std::uint32_t face) { return static_cast<std::uint8_t>(1 << face); }

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
    const CellFaces outer(model, tied_faces(model));
    for (Row t = 0; t < static_cast<Row>(model.triangles.size()); ++t) {
        const Row partner = outer.partner(t);
        if (partner < t) continue; // none, or both are done
        const auto& triangles = model.triangles.gridpoints;
        const std::array<Row, 4> corners = led(leader, corners_of_face(triangles[t], triangles[partner]));
        const Row first = corners.front();
        const auto found = std::find_if(faces.begin(first), faces.end(first),
                                        [&](const CellFace& f) { return corners_of(model, leader, f) == corners; });
        if (found == faces.end(first)) continue; // cells whose zones are on their own
        ruled[found->cell] |= bit_of(found->face);
        laws.tiles.outer[found->cell] |= bit_of(found->face);
    }
    const auto rule = [&](const CellFace& f) { ruled[f.cell] |= bit_of(f.face); };
    for (Row g = 0; g < static_cast<Row>(model.gridpoints.size()); ++g)
        for (auto face = faces.begin(g); face != faces.end(g); ++face)
            for (auto other = face + 1; other != faces.end(g); ++other)
                if (corners_of(model, leader, *face) == corners_of(model, leader, *other)) {
                    rule(*face);
                    rule(*other);
                }
}

} // namespace kaya
