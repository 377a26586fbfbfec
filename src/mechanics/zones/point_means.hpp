// Means over the zones at each gridpoint and back: docs/theory/zones.md, mixed discretisation.
#pragma once

#include "base/parallel.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace kaya {

/// Sums of quantities times volume, and of the volume.
template <std::size_t n> struct PointMean {
    std::array<double, n> sum{};
    double volume = 0;
};

/// Calls each(tile) for all tiles whose laws are coupled in this way.
template <class Each> void for_tiles(const ZoneLaws& laws, Together together, const Each& each) {
    const auto& tiles = laws.tiles.tiles;
    for_chunks(tiles.size(), 1, [&](std::size_t first, std::size_t) {
        if (laws.laws[tiles[first].law].together == together) each(tiles[first]);
    });
}

/// Calls each(zone, count, deformation) for groups of eight zones of these tiles: the first zone, how many there are from it on in its tile, and
/// their Deformation or VolumeStrain in the step.
template <class Change, class Each>
void for_deformations(const Model& model, const ZoneLaws& laws, Together together, const Each& each) {
    for_tiles(laws, together, [&](const ZoneTile& tile) {
        const TileRows rows(model, laws.tiles, tile);
        for (Row z = tile.first; z < tile.last; z += eight) {
            const ZoneGroup group = rows.group_at(z);
            each(z, tile.last - z, rows.deformation<Change>(group, rows.edges(group), model.settings.large_strain));
        }
    });
}

/// Means of `n` quantities over neighbours, by volume: over the zones at each gridpoint and back. Zones of other blocks and materials do not
/// count. `value(zone)` returns the quantities of a zone, `put(zone, means)` takes their means; `sums` is scratch memory.
template <std::size_t n, class Value, class Put>
void average_at_points(const ZoneLaws& laws, Together together, const std::vector<double>& volume,
                       std::vector<PointMean<n>>& sums, const Value& value, const Put& put) {
    const ZoneTiles& tiles = laws.tiles;
    sums.resize(tiles.gridpoints.size());
    for_tiles(laws, together, [&](const ZoneTile& tile) {
        auto* const here = sums.data() + tile.points.first;
        std::fill_n(here, tile.points.count, PointMean<n>{});
        for (Row z = tile.first; z < tile.last; ++z) {
            const double size = volume[z];
            std::array<double, n> part = value(z);
            for (double& v : part) v *= size;
            for (const Row p : tiles.corners[z]) {
                for (std::size_t k = 0; k < n; ++k) here[p].sum[k] += part[k];
                here[p].volume += size;
            }
        }
    });
    for_tiles(laws, together, [&](const ZoneTile& tile) {
        std::array<std::array<double, n>, most_points_in_tile> mean;
        for (Row p = 0; p < tile.points.count; ++p) {
            const Row g = tiles.gridpoints[tile.points.first + p];
            PointMean<n> whole;
            for (auto part = tiles.points_of.begin(g); part != tiles.points_of.end(g); ++part) {
                for (std::size_t k = 0; k < n; ++k) whole.sum[k] += sums[*part].sum[k];
                whole.volume += sums[*part].volume;
            }
            for (std::size_t k = 0; k < n; ++k) mean[p][k] = whole.sum[k] / whole.volume;
        }
        for (Row z = tile.first; z < tile.last; ++z) {
            const auto& c = tiles.corners[z];
            std::array<double, n> means;
            for (std::size_t k = 0; k < n; ++k)
                means[k] = 0.25 * (mean[c[0]][k] + mean[c[1]][k] + mean[c[2]][k] + mean[c[3]][k]);
            put(z, means);
        }
    });
}

} // namespace kaya
