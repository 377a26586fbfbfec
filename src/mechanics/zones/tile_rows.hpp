// Data for the work on the zones of a tile: its gridpoints in rows, forces on them, and stresses.
#pragma once

#include "mechanics/common/crushed_zones.hpp"
#include "mechanics/zones/tetrahedra.hpp"
#include "mechanics/zones/zone_tiles.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace kaya {

static_assert(cells_of_group == eight);
using CellGroupCorners = const CellCorners*; ///< of eight cells

/// Forces on the corners of eight cells.
using CellForces = std::array<Eight3, 8>;

/// The points of a tile in rows, which stay in the processor's cache while its zones are processed.
class TileRows {
public:
    /// `pressure`: pore pressure by gridpoint; empty for laws without it.
    TileRows(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const std::vector<double>& pressure = {})
        : tiles_(tiles), tile_(tile) {
        const bool wet = !pressure.empty();
        const double step = model.clock.time_step;
        const LaneGroup three(3);
        for (Row i = 0; i < tile.points.count; ++i) {
            const Row g = tiles.gridpoints[tile.points.first + i];
            store(place_[i].value.data(), three.load(model.gridpoints.position[g].data()));
            store(shift_[i].value.data(), step * three.load(model.gridpoints.velocity[g].data()));
            if (wet) place_[i].value[3] = pressure[g];
        }
        tail_.fill(tiles.corners[tile.last - 1]);
        const Row whole = std::min<Row>(tile.last - tile.first, eight);
        std::copy_n(&tiles.corners[tile.last - whole], whole, &tail_[eight - whole]);
    }

    /// Eight zones from one on; after the last of the tile the last again.
    ZoneGroup group_at(Row zone) const {
        return tile_.last - zone >= eight ? &tiles_.corners[zone] : tail_.data() + (eight - (tile_.last - zone));
    }
    Edges edges(ZoneGroup zones) const { return edges_of(place_, zones); }
    /// Their Deformation or VolumeStrain in the step.
    template <class Change = Deformation> Change deformation(ZoneGroup zones, const Edges& edges, bool large) const {
        return {edges, edges_of(shift_, zones), large};
    }
    Eight pressure(ZoneGroup zones) const { return mean_of_fourth(place_, zones); }

    /// The cells of the group that begins with a zone, and the bits of their ruled faces.
    CellGroupCorners cells_at(Row zone) const { return &tiles_.cells[tile_.cell(zone)]; }
    const std::uint8_t* ruled(Row zone) const { return &tiles_.ruled[tile_.cell(zone)]; }
    const std::uint8_t* outer(Row zone) const { return &tiles_.outer[tile_.cell(zone)]; }
    const PointRow* places() const { return place_; } ///< and the pore pressure
    const PointRow* shifts() const { return shift_; } ///< of the step

private:
    const ZoneTiles& tiles_;
    const ZoneTile& tile_;
    PointRow place_[most_points_in_tile], shift_[most_points_in_tile];
    std::array<ZoneCorners, 2 * eight> tail_; ///< the last zones of the tile, and then the last again
};

/// Rows of corner `c` of eight cells.
[[gnu::always_inline]] inline EightRow load_corner(const PointRow* rows, CellGroupCorners cells, std::size_t c) {
    std::array<Four, 8> r;
    for (std::size_t l = 0; l < 8; ++l) r[l] = load_as<Four>(rows[cells[l][c]].value.data());
    const std::array<Eight, 4> columns = columns_of_rows(r);
    return {{columns[0], columns[1], columns[2]}, columns[3]};
}

/// Throws if one of `count` zones has no volume; their rows are `each` apart.
inline void check_volumes(const Model& model, Row zone, Row each, Row count, const Eight& volume) {
    if (all_above_zero(volume)) return;
    for (Row l = 0; l < count; ++l)
        if (!(volume[l] > 0)) throw turned_over(model, zone + each * l);
}

/// Forces of stresses on the points of a tile, in rows with the sums of their sizes.
class TileForces {
public:
    TileForces(const ZoneTile& tile, std::vector<PointRow>& forces) : rows_(forces.data() + tile.points.first) {
        std::fill_n(rows_, tile.points.count, PointRow{});
    }
    [[gnu::always_inline]] void add(ZoneGroup zones, Row count, const Edges& edges, const SixEights& stress) {
        const std::array<Eight3, 4> force = forces_of(edges, stress);
        std::array<Eight, 4> size;
        for (std::size_t a = 0; a < 4; ++a) size[a] = square_root(force[a].dot(force[a]));
        add_to_corners(rows_, zones, count, force, size);
    }
    [[gnu::always_inline]] void add(CellGroupCorners corners, Row cells, const CellForces& forces) {
        for (std::size_t c = 0; c < 8; ++c) {
            const Eight3& f = forces[c];
            const std::array<Four, 8> r = rows_of_columns({f.x, f.y, f.z, square_root(f.dot(f))});
            for (std::size_t l = 0; l < static_cast<std::size_t>(cells); ++l) {
                double* const row = rows_[corners[l][c]].value.data();
                store(row, Four(load_as<Four>(row) + r[l]));
            }
        }
    }

private:
    PointRow* rows_;
};

/// Six numbers of each of eight rows, or of fewer at the end, `stride` numbers apart. A row may store several copies.
[[gnu::always_inline]] inline SixEights load_six(const double* rows, std::size_t stride, Row count) {
    if (count >= eight) return six_columns(rows, stride);
    std::array<double, 6 * eight> few{};
    for (Row l = 0; l < count; ++l) std::copy_n(rows + stride * static_cast<std::size_t>(l), 6, &few[6 * l]);
    return six_columns(few.data(), 6);
}
[[gnu::always_inline]] inline void store_six(double* rows, std::size_t stride, Row count, const SixEights& columns,
                                             Row copies = 1) {
    if (count >= eight) return put_six_columns(rows, stride, columns, static_cast<std::size_t>(copies));
    std::array<double, 6 * eight> few;
    put_six_columns(few.data(), 6, columns);
    for (Row l = 0; l < count; ++l)
        for (Row n = 0; n < copies; ++n)
            std::copy_n(&few[6 * l], 6, rows + stride * static_cast<std::size_t>(l) + 6 * n);
}

/// Stresses of eight zones that follow each other, or of as many as there are.
inline SixEights load_stresses(const Column<Stress>& stresses, Row first, Row count) {
    return load_six(stresses[first].data(), 6, count);
}
inline void store_stresses(Column<Stress>& stresses, Row first, Row count, const SixEights& stress) {
    store_six(stresses[first].data(), 6, count, stress);
}

} // namespace kaya
