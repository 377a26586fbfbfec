#include "mechanics/ruled_faces.hpp"

#include "mechanics/tile_rows.hpp"

#include <algorithm>
#include <numeric>

namespace kaya {

namespace {

/// Corners of the faces of a cell, in the order of RuledFaces.
constexpr std::size_t corners_of_face[zones_of_cell][4] = {{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3},
                                                           {1, 3, 5, 7}, {2, 3, 6, 7}, {4, 5, 6, 7}};

struct Face {
    std::array<Row, 4> corners; ///< ascending; of a group of tied gridpoints the first
    Row cell;                   ///< its first zone
    std::uint8_t bit;           ///< in ZoneTiles::ruled
};

/// For each gridpoint the first of its group, else itself.
std::vector<Row> leaders(const Model& model, const TieLists& ties) {
    std::vector<Row> leader(model.gridpoints.size());
    std::iota(leader.begin(), leader.end(), Row{0});
    for (std::size_t group = 0; group < ties.groups(); ++group)
        for (const Row g : ties.members(group)) leader[g] = ties.members(group).front();
    return leader;
}

} // namespace

void find_ruled_faces(const Model& model, const TieLists& ties, ZoneLaws& laws) {
    auto& ruled = laws.tiles.ruled;
    const std::vector<Row> leader = leaders(model, ties);
    std::vector<Face> faces;
    for (const ZoneTile& tile : laws.tiles.tiles) {
        if (laws.laws[tile.law].together != Together::cells) continue;
        for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell) {
            const std::array<Row, 8> cell = corners_of_cell(&model.zones.gridpoints[zone]);
            for (Row f = 0; f < zones_of_cell; ++f) {
                Face& face = faces.emplace_back();
                face.cell = zone;
                face.bit = static_cast<std::uint8_t>(1 << f);
                for (std::size_t k = 0; k < 4; ++k) face.corners[k] = leader[cell[corners_of_face[f][k]]];
                std::ranges::sort(face.corners);
            }
        }
    }
    std::ranges::sort(faces, {}, &Face::corners);
    for (std::size_t i = 1; i < faces.size(); ++i)
        if (faces[i].corners == faces[i - 1].corners)
            for (const Face& face : {faces[i - 1], faces[i]}) ruled[face.cell] |= face.bit;
}

} // namespace kaya
