#include "base/reduce.hpp"
#include "laws/zone_trial.hpp"
#include "mechanics/zones/cell_forces.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/run_cells.hpp"
#include "mechanics/zones/run_flowing_cells.hpp"
#include "mechanics/zones/run_zone_models.hpp"
#include "mechanics/zones/shared_faces.hpp"
#include "mechanics/zones/tile_rows.hpp"
#include "mechanics/zones/viscous_stress.hpp"
#include "mechanics/zones/zone_columns.hpp"
#include "mechanics/zones/zone_laws.hpp"
#include "model/measure/water.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <span>

namespace kaya {

namespace {

/// The part of a plastic change of the mean stress that is more than the rounding of sums of this size; otherwise 0.
Eight beyond_rounding(const Eight& flow, const Eight& size) {
    constexpr double part = 64 * std::numeric_limits<double>::epsilon();
    return size_of(flow) > part * size ? flow : Eight{};
}

/// Work of one tile on its zones, without averaging of flow.
class TileRun {
public:
    TileRun(Model& model, const ZoneLaws& laws, const ZoneTile& tile, ZoneScratch& scratch,
            std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(laws.laws[tile.law]), scratch_(scratch),
          averages_(law_.together == Together::at_points), shares_(law_.together == Together::strains_at_points),
          damped_(stiffness_damping(model.settings) > 0), rows_(model, laws.tiles, tile, scratch.pressure),
          forces_(tile, forces) {}

    ZoneSums run() {
        ZoneSums sums;
        const Row whole = static_cast<Row>(most_zones_in_batch);
        for (Row first = tile_.first; first < tile_.last; first += whole)
            sums.add(run_batch(first, std::min(whole, tile_.last - first)));
        return sums;
    }

private:
    ZoneSums run_batch(Row first, Row count) {
        ZoneColumns columns(model_, first, count, law_);
        strain(columns, first, count);
        const auto failure = run_guarded(*law_.model, columns.batch, model_.clock.cycle, first + 1);
        if (failure) throw failed_zone(model_, law_, first + static_cast<Row>(failure->row), *failure);
        ZoneSums sums = finish(columns, first, count);
        if (damped_) {
            sums.add(damp(columns, first, count, stiffness_damping(model_.settings) / model_.clock.time_step));
            if (!shares_) add_damped_forces(columns, first, count);
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
            check_volumes(model_, first + i, 1, std::min<Row>(count - i, eight), d.volume);
            columns.keep(i, edges);
            store(columns.volume + i, d.volume);
            const Eight pressure = wet ? rows_.pressure(zones) : Eight{};
            store(columns.pressure + i, pressure);
            SixEights strain = d.strain;
            Eight volume_strain = d.volume_strain;
            if (averages_) {
                const Eight more =
                    (load_rows(scratch_.mean_strain.data() + first + i, count - i) - d.volume_strain) / 3.0;
                for (std::size_t k = 0; k < 3; ++k) strain[k] += more;
            } else if (shares_) {
                strain = load_six(scratch_.shared.strain[first + i].data(), 6, count - i);
                const SixEights own = load_six(scratch_.shared.own[first + i].data(), 6, count - i);
                volume_strain = own[0] + own[1] + own[2]; // at outer faces another than that of the tetrahedron
            }
            if (averages_ || shares_) store(columns.volume_strain + i, volume_strain);
            SixEights stress = load_stresses(model_.zones.stress, first + i, count - i);
            if (large) {
                stress = turned(stress, d.half_spin);
                store_spin(columns, i, d.half_spin);
            }
            for (std::size_t k = 0; k < 6; ++k) {
                store(columns.strain[k] + i, strain[k]);
                store(columns.before[k] + i, stress[k]);
                store(columns.stress[k] + i, k < 3 ? stress[k] + pressure : stress[k]);
            }
        }
    }

    /// Writes total stresses to the zones, updates their state, and computes their forces, unless other stresses are added or act.
    ZoneSums finish(ZoneColumns& columns, Row first, Row count) {
        const double bulk = law_.elastic.bulk();
        const bool are_final = !shares_ && !damped_;
        Lanes whole = Lanes{};
        bool flowed = false;
        for (Row i = 0; i < count; i += eight) {
            const Eight pressure = ZoneColumns::at(columns.pressure + i);
            Eight work{}, change{}, both{}, size = size_of(pressure);
            SixEights stresses;
            for (std::size_t k = 0; k < 6; ++k) {
                const Eight before = ZoneColumns::at(columns.before[k] + i);
                Eight stress = ZoneColumns::at(columns.stress[k] + i);
                if (k < 3) {
                    stress -= pressure;
                    change += stress - before;
                    both += stress + before;
                    size += size_of(stress) + size_of(before);
                }
                const Eight part = (before + stress) * ZoneColumns::at(columns.strain[k] + i);
                work += k < 3 ? part : 2 * part;
                stresses[k] = stress;
            }
            if (averages_) {
                const Eight mean = load_rows(scratch_.mean_strain.data() + first + i, count - i);
                const Eight flow = beyond_rounding(change / 3.0 - bulk * mean, size);
                flowed = flowed || !all_zero(flow);
                store_rows(scratch_.flow.data() + first + i, count - i, flow);
                work +=
                    both / 3.0 *
                    (ZoneColumns::at(columns.volume_strain + i) - mean); // the forces act on the zone's own deformation
            } else if (shares_) { // the pore pressure acts on the zone's own deformation
                const Eight mean = ZoneColumns::at(columns.strain[0] + i) + ZoneColumns::at(columns.strain[1] + i) +
                                   ZoneColumns::at(columns.strain[2] + i);
                work += 2.0 * pressure * (mean - ZoneColumns::at(columns.volume_strain + i));
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
        ZoneSums sums;
        sums.work = sum(whole);
        sums.flowed = flowed;
        return sums;
    }

    /// Adds viscous stresses, and the work that they dissipate, before what flow makes of them is averaged.
    ZoneSums damp(const ZoneColumns& columns, Row first, Row count, double damping) {
        const double bulk = damping * law_.elastic.bulk();
        Lanes whole = Lanes{};
        bool flowed = false;
        for (Row i = 0; i < count; i += eight) {
            const Row rows = std::min<Row>(count - i, eight);
            SixEights change, strain;
            Eight size = size_of(ZoneColumns::at(columns.pressure + i));
            for (std::size_t k = 0; k < 6; ++k) {
                const Eight after = ZoneColumns::at(columns.stress[k] + i),
                            before = ZoneColumns::at(columns.before[k] + i);
                change[k] = after - before;
                strain[k] = ZoneColumns::at(columns.strain[k] + i);
                if (k < 3) size += size_of(after) + size_of(before);
            }
            const SixEights last = load_stresses(model_.zones.dashpot, first + i, rows),
                            now = viscous_stress(change, strain, law_.elastic, damping), both = sum(last, now);
            store_stresses(model_.zones.dashpot, first + i, rows, now);
            Eight work = product(both, strain);
            if (averages_) {
                const Eight mean = load_rows(scratch_.mean_strain.data() + first + i, rows);
                const Eight flow = beyond_rounding(mean_of_three(now) - bulk * mean, damping * size);
                flowed = flowed || !all_zero(flow);
                store_rows(scratch_.viscous_flow.data() + first + i, rows, flow);
                work += mean_of_three(both) * (ZoneColumns::at(columns.volume_strain + i) - mean);
            }
            Eight energy = 0.5 * ZoneColumns::at(columns.volume + i) * work;
            for (Row l = rows; l < eight; ++l) energy[l] = 0;
            add_to(whole, energy);
        }
        ZoneSums sums;
        sums.damped = sum(whole);
        sums.flowed = flowed;
        return sums;
    }

    /// Forces of the stresses of the zones and of their dashpots.
    void add_damped_forces(const ZoneColumns& columns, Row first, Row count) {
        for (Row i = 0; i < count; i += eight) {
            SixEights stress = load_stresses(model_.zones.dashpot, first + i, count - i);
            for (std::size_t k = 0; k < 6; ++k) stress[k] = ZoneColumns::at(columns.stress[k] + i) + stress[k];
            forces_.add(rows_.group_at(first + i), std::min<Row>(count - i, eight), columns.edges(i), stress);
        }
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    ZoneScratch& scratch_;
    const bool averages_; ///< volume strains over gridpoints, and then flow
    const bool shares_;   ///< strains and stresses with the zones at its gridpoints
    const bool damped_;   ///< by viscous stresses
    TileRows rows_;
    TileForces forces_;
};

/// Once for all tiles: below a ground surface it is slow.
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

/// Means of one quantity of averaging zones.
template <class Put>
void average(const ZoneLaws& laws, ZoneScratch& scratch, const std::vector<double>& values, const Put& put) {
    average_at_points(
        laws, Together::at_points, scratch.volume, scratch.at_point, [&](Row z) { return std::array{values[z]}; },
        [&](Row z, const std::array<double, 1>& mean) { put(z, mean[0]); });
}

/// Volume strains of averaging zones, and their means.
void average_strain(const Model& model, const ZoneLaws& laws, ZoneScratch& scratch) {
    const std::size_t zones = model.zones.size();
    for (auto* column : {&scratch.volume, &scratch.strain, &scratch.mean_strain, &scratch.flow, &scratch.viscous_flow})
        column->resize(zones);
    for_deformations<VolumeStrain>(model, laws, Together::at_points, [&](Row z, Row count, const VolumeStrain& d) {
        store_rows(scratch.volume.data() + z, count, d.volume);
        store_rows(scratch.strain.data() + z, count, d.volume_strain);
    });
    average(laws, scratch, scratch.strain, [&](Row z, double mean) { scratch.mean_strain[z] = mean; });
}

/// Forces of all zones of a tile from their present stresses, or from those that they share.
void add_all(const Model& model, const ZoneLaws& laws, const ZoneTile& tile, const SharedStrains& shared,
             std::vector<PointRow>& forces) {
    const ZoneLaw& law = laws.laws[tile.law];
    if (by_cells(law.together)) return cell_forces(model, laws.tiles, tile, law, forces);
    const TileRows rows(model, laws.tiles, tile);
    TileForces sums(tile, forces);
    const bool shares = law.together == Together::strains_at_points, damped = !shares && zones_are_damped(model);
    for (Row z = tile.first; z < tile.last; z += eight) {
        SixEights stress = shares ? load_six(shared.stress[z].data(), 6, tile.last - z)
                                  : load_stresses(model.zones.stress, z, tile.last - z);
        if (damped) {
            const SixEights viscous = load_stresses(model.zones.dashpot, z, tile.last - z);
            for (std::size_t k = 0; k < 6; ++k) stress[k] += viscous[k];
        }
        const ZoneGroup zones = rows.group_at(z);
        sums.add(zones, std::min<Row>(tile.last - z, eight), rows.edges(zones), stress);
    }
}

/// Averages what flow changes of the mean stress, and of the viscous one, then computes the forces of the tiles that it reaches. Returns the
/// corresponding work.
ZoneSums average_flow(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces) {
    const bool damped = zones_are_damped(model);
    const auto find_changes = [&](std::vector<double>& flow) {
        average(laws, scratch, flow, [&](Row z, double mean) { flow[z] = mean - flow[z]; });
    };
    const auto none_in = [](const std::vector<double>& changes, const ZoneTile& tile) {
        return all_zero_rows(changes.data() + tile.first, tile.last - tile.first);
    };
    find_changes(scratch.flow);
    if (damped) find_changes(scratch.viscous_flow);
    const auto& tiles = laws.tiles.tiles;
    return reduce_chunks(
        tiles.size(), 1, ZoneSums{},
        [&](std::size_t first, std::size_t) {
            ZoneSums sums;
            const ZoneTile& tile = tiles[first];
            if (laws.laws[tile.law].together != Together::at_points) return sums;
            if (none_in(scratch.flow, tile) && (!damped || none_in(scratch.viscous_flow, tile))) return sums;
            for (Row z = tile.first; z < tile.last; ++z) {
                for (int k = 0; k < 3; ++k) model.zones.stress[z][k] += scratch.flow[z];
                sums.work += 0.5 * scratch.volume[z] * scratch.flow[z] * scratch.strain[z];
                if (!damped) continue;
                for (int k = 0; k < 3; ++k) model.zones.dashpot[z][k] += scratch.viscous_flow[z];
                sums.damped += 0.5 * scratch.volume[z] * scratch.viscous_flow[z] * scratch.strain[z];
            }
            add_all(model, laws, tile, scratch.shared, forces);
            return sums;
        },
        [](ZoneSums& sum, const ZoneSums& part) { sum.add(part); });
}

/// Forces of the stresses that zones share, after their laws.
void add_shared(const Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces) {
    share_stresses(model, laws, scratch.pressure, scratch.shared);
    for_tiles(laws, Together::strains_at_points,
              [&](const ZoneTile& tile) { add_all(model, laws, tile, scratch.shared, forces); });
    add_face_forces(model, laws, scratch.shared, forces);
}

} // namespace

void begin_zones(Model& model, const ZoneLaws& laws, ZoneScratch& scratch) {
    scratch.cells.make_room(laws.tiles);
    if (!scratch.cells.wanted) scratch.cells.give_back(model, laws.tiles);
    if (stiffness_damping(model.settings) > 0) {
        model.zones.keep_dashpots();
        if (model.zones.keeps_warps) model.zones.keep_warp_dashpots();
    }
    find_pressure(model, scratch.pressure);
    if (laws.any(Together::at_points)) average_strain(model, laws, scratch);
    if (laws.any(Together::strains_at_points)) share_strains(model, laws, scratch.shared);
}

bool tiles_go_alone(const Model& model, const ZoneLaws& laws) {
    return model.settings.water == Water::none && !laws.any(Together::at_points) &&
           !laws.any(Together::strains_at_points);
}

TileResult run_tile(Model& model, const ZoneLaws& laws, const ZoneTile& tile, ZoneScratch& scratch,
                    std::vector<PointRow>& forces) {
    const ZoneLaw& law = laws.laws[tile.law];
    try {
        if (law.together == Together::flow_in_cells)
            return {run_flowing_cells(model, laws.tiles, tile, law, scratch.pressure, forces), nullptr};
        if (law.together == Together::cells) return {run_cells(model, laws.tiles, tile, law, scratch, forces), nullptr};
        return {TileRun(model, laws, tile, scratch, forces).run(), nullptr};
    } catch (...) { return {{}, std::current_exception()}; }
}

ZoneSums run_zone_models(Model& model, const ZoneLaws& laws, ZoneScratch& scratch, std::vector<PointRow>& forces) {
    begin_zones(model, laws, scratch);
    const auto& tiles = laws.tiles.tiles;
    auto [sums, failure] = reduce_chunks(
        tiles.size(), 1, TileResult{},
        [&](std::size_t first, std::size_t) { return run_tile(model, laws, tiles[first], scratch, forces); },
        [](TileResult& whole, const TileResult& part) {
            whole.sums.add(part.sums);
            if (!whole.failure) whole.failure = part.failure;
        });
    if (failure) std::rethrow_exception(failure);
    if (sums.flowed) sums.add(average_flow(model, laws, scratch, forces));
    if (laws.any(Together::strains_at_points)) add_shared(model, laws, scratch, forces);
    return sums;
}

void zone_forces(const Model& model, const ZoneLaws& laws, std::vector<PointRow>& forces) {
    const auto& tiles = laws.tiles.tiles;
    forces.resize(laws.tiles.gridpoints.size());
    SharedStrains shared;
    if (laws.any(Together::strains_at_points)) {
        std::vector<double> pressure;
        find_pressure(model, pressure);
        share_strains(model, laws, shared);
        share_stresses(model, laws, pressure, shared);
    }
    for_chunks(tiles.size(), 1,
               [&](std::size_t first, std::size_t) { add_all(model, laws, tiles[first], shared, forces); });
    add_face_forces(model, laws, shared, forces);
}

} // namespace kaya
