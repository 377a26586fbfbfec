#include "base/reduce.hpp"
#include "mechanics/cells.hpp"
#include "mechanics/crushed_zones.hpp"
#include "mechanics/dashpots.hpp"
#include "mechanics/run_zone_models.hpp"
#include "mechanics/tetrahedra.hpp"
#include "mechanics/zone_columns.hpp"
#include "mechanics/zone_laws.hpp"
#include "model/measure.hpp"
#include "model/water.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace {

/// The points of a tile in rows, which stay near the processor while its zones are worked on.
class TileRows {
public:
    /// `pressure` of the pores, by gridpoint; of who does not ask for it empty.
    TileRows(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const std::vector<double>& pressure = {})
        : tiles_(tiles), tile_(tile) {
        const bool wet = !pressure.empty();
        const double step = model.clock.time_step;
        for (Row i = 0; i < tile.points.count; ++i) {
            const Row g = tiles.gridpoints[tile.points.first + i];
            const Vec3 &x = model.gridpoints.position[g], shift = step * model.gridpoints.velocity[g];
            place[i].value = {x.x(), x.y(), x.z(), wet ? pressure[g] : 0};
            shift_[i].value = {shift.x(), shift.y(), shift.z(), 0};
        }
        tail_.fill(tiles.corners[tile.last - 1]);
        const Row whole = std::min<Row>(tile.last - tile.first, eight);
        std::copy_n(&tiles.corners[tile.last - whole], whole, &tail_[eight - whole]);
    }

    /// Eight zones from one on; after the last of the tile the last again.
    ZoneGroup group_at(Row zone) const {
        return tile_.last - zone >= eight ? &tiles_.corners[zone] : tail_.data() + (eight - (tile_.last - zone));
    }
    Edges edges(ZoneGroup zones) const { return edges_of(place, zones); }
    Deformation deformation(ZoneGroup zones, const Edges& edges, bool large) const {
        return {edges, edges_of(shift_, zones), large};
    }
    Eight pressure(ZoneGroup zones) const { return mean_of_fourth(place, zones); }

    /// The corners of eight cells from one on; after the last of the count that again.
    CellCorners cells_at(Row zone, Row count) const {
        CellCorners corners;
        for (Row l = 0; l < eight; ++l) {
            const auto own = corners_of_cell(&tiles_.corners[zone + zones_of_cell * std::min(l, count - 1)]);
            for (std::size_t c = 0; c < 8; ++c) corners[c][static_cast<std::size_t>(l)] = own[c];
        }
        return corners;
    }
    EightCorners places(const CellCorners& corners) const { return load_corners(place, corners); }
    EightCorners shifts(const CellCorners& corners) const { return load_corners(shift_, corners); }

private:
    const ZoneTiles& tiles_;
    const ZoneTile& tile_;
    PointRow place[most_points_in_tile];             ///< and the pore pressure
    PointRow shift_[most_points_in_tile];            ///< of the step
    std::array<std::array<Row, 4>, 2 * eight> tail_; ///< the last zones of the tile, and then the last again
};

/// Throws where a zone has no volume left.
void check_volumes(const Model& model, Row zone, Row count, const Eight& volume) {
    if (all_above_zero(volume)) return;
    for (Row l = 0; l < count; ++l)
        if (!(volume[l] > 0)) throw turned_over(model, zone + l);
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
    /// Forces of as many cells.
    void add(const CellCorners& corners, Row count, const EightCorners& forces) {
        for (std::size_t c = 0; c < 8; ++c) {
            const Eight3& f = forces[c];
            const std::array<Four, 8> r = rows_of_columns({f.x, f.y, f.z, square_root(f.dot(f))});
            for (std::size_t l = 0; l < static_cast<std::size_t>(count); ++l) {
                double* const row = rows_[corners[c][l]].value.data();
                store(row, Four(load_as<Four>(row) + r[l]));
            }
        }
    }

private:
    PointRow* rows_;
};

/// Stresses of eight zones that follow each other, or of as many as there are.
SixEights load_stresses(const Column<Stress>& stresses, Row first, Row count) {
    if (count >= eight) return six_columns(stresses[first].data());
    std::array<double, 6 * eight> rows{};
    for (Row l = 0; l < count; ++l) std::copy_n(stresses[first + l].data(), 6, &rows[6 * l]);
    return six_columns(rows.data());
}
void store_stresses(Column<Stress>& stresses, Row first, Row count, const SixEights& stress) {
    if (count >= eight) return put_six_columns(stresses[first].data(), stress);
    std::array<double, 6 * eight> rows;
    put_six_columns(rows.data(), stress);
    for (Row l = 0; l < count; ++l) std::copy_n(&rows[6 * l], 6, stresses[first + l].data());
}

/// Whether damping takes the motion away, so that only where it ends counts.
bool goes_to_rest(const Settings& settings) {
    return !settings.dynamic && settings.damping != Damping::none && settings.damping != Damping::rayleigh;
}

/// Work of one tile on its zones.
class TileRun {
public:
    TileRun(Model& model, const ZoneLaws& laws, const ZoneTile& tile, ZoneScratch& scratch,
            std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(laws.laws[tile.law]), scratch_(scratch),
          damped_(stiffness_damping(model.settings) > 0), together_(law_.cells && goes_to_rest(model.settings)),
          rows_(model, laws.tiles, tile, scratch.pressure), forces_(tile, forces) {}

    ZoneSums run() {
        ZoneSums sums;
        const Row whole = static_cast<Row>(law_.cells ? most_of_cells_in_batch : most_zones_in_batch);
        for (Row first = tile_.first; first < tile_.last; first += whole)
            sums.add(run_batch(first, std::min(whole, tile_.last - first)));
        return sums;
    }

private:
    ZoneSums run_batch(Row first, Row count) {
        ZoneColumns columns(model_, first, count, law_);
        strain(columns, first, count);
        if (together_) give_mean_motion(columns, count);
        if (const auto failure = law_.model->run(columns.batch, first + 1)) throw failed(first, *failure);
        ZoneSums sums;
        sums.work = finish(columns, first, count);
        if (law_.cells) sums.work += warp(first, count);
        if (damped_) {
            sums.damped = damp(columns, first, count, stiffness_damping(model_.settings) / model_.clock.time_step);
            if (!law_.averages) add_damped_forces(columns, first, count);
        }
        return sums;
    }

    /// Strains of the step, and the stresses turned with the material.
    void strain(ZoneColumns& columns, Row first, Row count) {
        const bool large = model_.settings.large_strain;
        const bool wet = model_.settings.water != Water::none;
        for (Row i = 0; i < count; i += eight) {
            const ZoneGroup zones = rows_.group_at(first + i);
            const Edges edges = rows_.edges(zones);
            const Deformation d = rows_.deformation(zones, edges, large);
            check_volumes(model_, first + i, std::min<Row>(count - i, eight), d.volume);
            columns.keep(i, edges);
            store(columns.volume + i, d.volume);
            const Eight pressure = wet ? rows_.pressure(zones) : Eight{};
            store(columns.pressure + i, pressure);
            Eight more{};
            if (law_.averages) {
                more = (load_rows(scratch_.mean_strain.data() + first + i, count - i) - d.volume_strain) / 3.0;
                store(columns.volume_strain + i, d.volume_strain);
            }
            SixEights stress = load_stresses(model_.zones.stress, first + i, count - i);
            if (together_) {
                store(columns.half_spin[0] + i, d.half_spin.x);
                store(columns.half_spin[1] + i, d.half_spin.y);
                store(columns.half_spin[2] + i, d.half_spin.z);
            } else if (large) {
                stress = turned(stress, d.half_spin);
            }
            for (std::size_t k = 0; k < 6; ++k) {
                store(columns.strain[k] + i, k < 3 ? d.strain[k] + more : d.strain[k]);
                store(columns.before[k] + i, stress[k]);
                store(columns.stress[k] + i, k < 3 ? stress[k] + pressure : stress[k]);
            }
        }
    }

    /// All zones of a cell have the mean strain of the cell, and their stresses turn with it.
    void give_mean_motion(ZoneColumns& columns, Row count) const {
        for (Row i = 0; i < count; i += zones_of_cell) {
            const double* const volume = columns.volume + i;
            double whole = 0;
            for (Row z = 0; z < zones_of_cell; ++z) whole += volume[z];
            const auto fill_mean = [&](double* rows) {
                double sum = 0;
                for (Row z = 0; z < zones_of_cell; ++z) sum += volume[z] * rows[z];
                std::fill_n(rows, zones_of_cell, sum / whole);
            };
            for (std::size_t k = 0; k < 6; ++k) {
                std::copy_n(columns.strain[k] + i, zones_of_cell, columns.own_strain[k] + i);
                fill_mean(columns.strain[k] + i);
            }
            for (auto& spin : columns.half_spin) fill_mean(spin + i);
        }
        if (!model_.settings.large_strain) return;
        for (Row i = 0; i < count; i += eight) {
            const Eight pressure = ZoneColumns::at(columns.pressure + i);
            const auto spin = [&](std::size_t k) { return ZoneColumns::at(columns.half_spin[k] + i); };
            SixEights stress;
            for (std::size_t k = 0; k < 6; ++k) stress[k] = ZoneColumns::at(columns.before[k] + i);
            stress = turned(stress, {spin(0), spin(1), spin(2)});
            for (std::size_t k = 0; k < 6; ++k) {
                store(columns.before[k] + i, stress[k]);
                store(columns.stress[k] + i, k < 3 ? stress[k] + pressure : stress[k]);
            }
        }
    }

    /// Cells also bend and twist. Returns the work that this takes.
    double warp(Row first, Row count) {
        const LayerModuli moduli =
            together_ ? LayerModuli(law_.elastic.lambda, law_.elastic.two_shear) : LayerModuli(0, 0);
        Lanes whole = Lanes::Zero();
        for (Row i = 0; i < count; i += zones_of_cell * static_cast<Row>(eight)) {
            const Row zone = first + i, cells = std::min<Row>((count - i) / zones_of_cell, eight);
            const CellCorners corners = rows_.cells_at(zone, cells);
            const EightCorners shift = rows_.shifts(corners), end = rows_.places(corners);
            const CellShape shape(end);
            WarpStress stress = load_warps(model_.zones, law_.cell_history, zone, cells);
            Eight work;
            if (model_.settings.large_strain) {
                EightCorners middle = end;
                for (std::size_t c = 0; c < 8; ++c) middle[c] = end[c] - shift[c] * eights(0.5);
                work = add_warp_stress(CellShape(middle), shift, moduli, stress);
            } else {
                work = add_warp_stress(shape, shift, moduli, stress);
            }
            for (Row l = cells; l < eight; ++l) work[l] = 0;
            add_to(whole, work);
            store_warps(model_.zones, law_.cell_history, zone, cells, stress);
            forces_.add(corners, cells, warp_forces(shape, stress));
        }
        return sum(whole);
    }

    /// Total stresses into the zones, what the step has done to them, and their forces, if nothing more comes to the stresses.
    double finish(ZoneColumns& columns, Row first, Row count) {
        const double bulk = law_.elastic.lambda + law_.elastic.two_shear / 3;
        const bool are_final = !law_.averages && !damped_;
        Lanes whole = Lanes::Zero();
        for (Row i = 0; i < count; i += eight) {
            const Eight pressure = ZoneColumns::at(columns.pressure + i);
            Eight work{}, change{}, both{};
            SixEights stresses;
            for (std::size_t k = 0; k < 6; ++k) {
                const Eight before = ZoneColumns::at(columns.before[k] + i);
                Eight stress = ZoneColumns::at(columns.stress[k] + i);
                if (k < 3) {
                    stress -= pressure;
                    change += stress - before;
                    both += stress + before;
                }
                // The forces act on what the zone itself does.
                const Eight part =
                    (before + stress) * ZoneColumns::at((together_ ? columns.own_strain[k] : columns.strain[k]) + i);
                work += k < 3 ? part : 2 * part;
                stresses[k] = stress;
            }
            if (law_.averages) {
                const Eight mean = load_rows(scratch_.mean_strain.data() + first + i, count - i);
                store_rows(scratch_.flow.data() + first + i, count - i, change / 3.0 - bulk * mean);
                work +=
                    both / 3.0 *
                    (ZoneColumns::at(columns.volume_strain + i) - mean); // the forces act on what the zone itself does
            }
            Eight energy = 0.5 * ZoneColumns::at(columns.volume + i) * work;
            for (Row l = count - i; l < eight; ++l) energy[l] = 0;
            add_to(whole, energy);
            store_stresses(model_.zones.stress, first + i, count - i, stresses);
            if (are_final)
                forces_.add(rows_.group_at(first + i), std::min<Row>(count - i, eight), columns.edges(i), stresses);
            else if (damped_)
                for (std::size_t k = 0; k < 3; ++k) store(columns.stress[k] + i, stresses[k]);
        }
        return sum(whole);
    }

    /// Viscous stresses besides. Returns the work that they take up.
    double damp(const ZoneColumns& columns, Row first, Row count, double damping) {
        double whole = 0;
        for (Row i = 0; i < count; ++i) {
            Stress& dashpot = model_.zones.dashpot[first + i];
            double work = 0;
            for (int k = 0; k < 6; ++k) {
                const double after = damping * (columns.stress[k][i] - columns.before[k][i]);
                work += (k < 3 ? 1 : 2) * (dashpot[k] + after) * columns.strain[k][i];
                dashpot[k] = after;
            }
            whole += 0.5 * columns.volume[i] * work;
        }
        return whole;
    }

    /// Forces of the stresses of the zones and of their dashpots.
    void add_damped_forces(const ZoneColumns& columns, Row first, Row count) {
        for (Row i = 0; i < count; i += eight) {
            SixEights stress = load_stresses(model_.zones.dashpot, first + i, count - i);
            for (std::size_t k = 0; k < 6; ++k) stress[k] = ZoneColumns::at(columns.stress[k] + i) + stress[k];
            forces_.add(rows_.group_at(first + i), std::min<Row>(count - i, eight), columns.edges(i), stress);
        }
    }

    Diagnostic failed(Row first, const ZoneFailure& failure) const {
        const Row zone = first + static_cast<Row>(failure.row), block = model_.zones.block[zone];
        const Vec3 centre = zone_centroid(model_, zone);
        Diagnostic d(failure.message, "look at the model's properties and at how fast the zones are loaded",
                     Fault::run);
        d.code = "zone-model-failed";
        d.add(fmt::format("zone {} of block {}, at ({:.6g}, {:.6g}, {:.6g})", zone + 1, model_.blocks.number[block],
                          centre.x(), centre.y(), centre.z()));
        const auto& place =
            model_.zone_properties[static_cast<std::size_t>(model_.blocks.zone_properties[block])].place;
        if (!place.empty()) d.add(fmt::format("zone model '{}' was given at {}", law_.model->name, place));
        return d;
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    ZoneScratch& scratch_;
    const bool damped_; ///< by viscous stresses
    const bool
        together_; ///< the zones of a cell; where motion is followed they are on their own, and what resists warping stays
    TileRows rows_;
    TileForces forces_;
};

/// Once for all tiles: below a ground surface it takes long.
void find_pressure(const Model& model, std::vector<double>& pressure) {
    pressure.clear();
    if (model.settings.water == Water::none || model.zones.size() == 0) return;
    pressure.resize(model.gridpoints.size());
    const WaterPressure water(model);
    constexpr std::size_t grain = 512;
    for_chunks(pressure.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t g = first; g < last; ++g) pressure[g] = water.at_gridpoint(static_cast<Row>(g));
    });
}

/// Calls each(tile) for all tiles whose law averages.
template <class Each> void for_averaging(const ZoneLaws& laws, Each each) {
    const auto& tiles = laws.tiles.tiles;
    for_chunks(tiles.size(), 1, [&](std::size_t first, std::size_t) {
        if (laws.laws[tiles[first].law].averages) each(tiles[first]);
    });
}

/// Means of a quantity over neighbours, by volume: over the cell of a zone where its block has cells, else over the zones at
/// each gridpoint and back. Zones of other blocks and of other materials do not count.
template <class Put> void average(const Model& model, const ZoneLaws& laws, ZoneScratch& scratch,
                                  std::vector<double>& values, const Put& put) {
    const auto& blocks = model.blocks;
    const auto& volume = scratch.volume;
    const ZoneTiles& tiles = laws.tiles;
    const auto has_cells = [&](Row zone) { return blocks.cell_zones[model.zones.block[zone]] > 0; };
    scratch.at_point.resize(tiles.gridpoints.size());
    for_averaging(laws, [&](const ZoneTile& tile) {
        auto* const sums = scratch.at_point.data() + tile.points.first;
        std::fill_n(sums, tile.points.count, ZoneScratch::Mean{});
        for (Row z = tile.first; z < tile.last; ++z)
            for (const Row p : tiles.corners[z]) {
                sums[p].sum += volume[z] * values[z];
                sums[p].volume += volume[z];
            }
    });
    for_averaging(laws, [&](const ZoneTile& tile) {
        std::array<double, most_points_in_tile> mean;
        for (Row p = 0; p < tile.points.count; ++p) {
            const Row g = tiles.gridpoints[tile.points.first + p];
            ZoneScratch::Mean whole;
            for (auto part = tiles.points_of.begin(g); part != tiles.points_of.end(g); ++part) {
                whole.sum += scratch.at_point[*part].sum;
                whole.volume += scratch.at_point[*part].volume;
            }
            mean[p] = whole.sum / whole.volume;
        }
        for (Row z = tile.first; z < tile.last; ++z) {
            if (has_cells(z)) continue;
            const auto& c = tiles.corners[z];
            put(z, 0.25 * (mean[c[0]] + mean[c[1]] + mean[c[2]] + mean[c[3]]));
        }
    });
    for_chunks(blocks.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Row cell = blocks.cell_zones[b];
            if (!blocks.deformable[b] || cell == 0 || !laws.of_block(static_cast<Row>(b)).averages) continue;
            const Span span = blocks.zones[b];
            for (Row z = span.first; z < span.end(); z += cell) {
                double sum = 0, whole = 0;
                for (Row k = z; k < z + cell; ++k) {
                    sum += volume[k] * values[k];
                    whole += volume[k];
                }
                for (Row k = z; k < z + cell; ++k) put(k, sum / whole);
            }
        }
    });
}

/// Volume strains of the zones that average, and their means.
void average_strain(const Model& model, const ZoneLaws& laws, ZoneScratch& scratch) {
    const std::size_t zones = model.zones.size();
    for (auto* column : {&scratch.volume, &scratch.strain, &scratch.mean_strain, &scratch.flow}) column->resize(zones);
    for_averaging(laws, [&](const ZoneTile& tile) {
        const TileRows rows(model, laws.tiles, tile);
        for (Row z = tile.first; z < tile.last; z += eight) {
            const ZoneGroup group = rows.group_at(z);
            const Deformation d = rows.deformation(group, rows.edges(group), model.settings.large_strain);
            store_rows(scratch.volume.data() + z, tile.last - z, d.volume);
            store_rows(scratch.strain.data() + z, tile.last - z, d.volume_strain);
        }
    });
    average(model, laws, scratch, scratch.strain, [&](Row z, double mean) { scratch.mean_strain[z] = mean; });
}

/// Forces of all zones of a tile with the stresses that they have.
void add_all(const Model& model, const ZoneLaws& laws, const ZoneTile& tile, std::vector<PointRow>& forces) {
    const TileRows rows(model, laws.tiles, tile);
    TileForces sums(tile, forces);
    const bool damped = stiffness_damping(model.settings) > 0; // else there is no viscous stress
    for (Row z = tile.first; z < tile.last; z += eight) {
        SixEights stress = load_stresses(model.zones.stress, z, tile.last - z);
        if (damped) {
            const SixEights viscous = load_stresses(model.zones.dashpot, z, tile.last - z);
            for (std::size_t k = 0; k < 6; ++k) stress[k] += viscous[k];
        }
        const ZoneGroup zones = rows.group_at(z);
        sums.add(zones, std::min<Row>(tile.last - z, eight), rows.edges(zones), stress);
    }
    const ZoneLaw& law = laws.laws[tile.law];
    if (!law.cells) return;
    for (Row z = tile.first; z < tile.last; z += zones_of_cell * static_cast<Row>(eight)) {
        const Row cells = std::min<Row>((tile.last - z) / zones_of_cell, eight);
        const CellCorners corners = rows.cells_at(z, cells);
        sums.add(corners, cells,
                 warp_forces(CellShape(rows.places(corners)), load_warps(model.zones, law.cell_history, z, cells)));
    }
}

/// The plastic change of the mean stress likewise; then the forces. Returns the work that goes with it.
ZoneSums average_flow(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces) {
    average(model, laws, scratch, scratch.flow, [&](Row z, double mean) { scratch.flow[z] = mean - scratch.flow[z]; });
    const auto& tiles = laws.tiles.tiles;
    return reduce_chunks(
        tiles.size(), 1, ZoneSums{},
        [&](std::size_t first, std::size_t) {
            ZoneSums sums;
            const ZoneTile& tile = tiles[first];
            if (!laws.laws[tile.law].averages) return sums;
            for (Row z = tile.first; z < tile.last; ++z) {
                for (int k = 0; k < 3; ++k) model.zones.stress[z][k] += scratch.flow[z];
                sums.work += 0.5 * scratch.volume[z] * scratch.flow[z] * scratch.strain[z];
            }
            add_all(model, laws, tile, forces);
            return sums;
        },
        [](ZoneSums& sum, const ZoneSums& part) { sum.add(part); });
}

} // namespace

ZoneSums run_zone_models(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces) {
    find_pressure(model, scratch.pressure);
    const bool averages = laws.any_averages();
    if (averages) average_strain(model, laws, scratch);
    const auto& tiles = laws.tiles.tiles;
    ZoneSums sums = reduce_chunks(
        tiles.size(), 1, ZoneSums{},
        [&](std::size_t first, std::size_t) { return TileRun(model, laws, tiles[first], scratch, forces).run(); },
        [](ZoneSums& sum, const ZoneSums& part) { sum.add(part); });
    if (averages) sums.add(average_flow(model, laws, scratch, forces));
    return sums;
}

void zone_forces(const Model& model, const ZoneLaws& laws, std::vector<PointRow>& forces) {
    const auto& tiles = laws.tiles.tiles;
    forces.resize(laws.tiles.gridpoints.size());
    for_chunks(tiles.size(), 1, [&](std::size_t first, std::size_t) { add_all(model, laws, tiles[first], forces); });
}

} // namespace kaya
