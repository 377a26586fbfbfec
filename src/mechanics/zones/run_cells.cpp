#include "mechanics/zones/run_cells.hpp"

#include "mechanics/zones/cell_forces.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/staged_zones.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace kaya {

namespace {

constexpr Row cells_in_batch = 32;
constexpr std::size_t groups_in_batch = cells_in_batch / eight;

/// Per-group data kept until the stresses are updated.
struct CellGroup {
    CellGroupCorners corners;
    CellShape shape;  ///< at the end of the step
    bool apart;       ///< the cells have initial stresses
    SixEights before; ///< the common stress of the zones, or their mean, turned with the cell
    Eight3 half_spin;
    Eight volume, work, damped; ///< in the middle of the step; work of the step, and of viscous stresses
    WarpStress warp;            ///< with viscous ones
};

/// Each cell is a row for the zone model. Its history is that of the first zone, and is then copied to all.
class CellRun {
public:
    CellRun(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
            std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(law), kept_(scratch.cells),
          moduli_(law.elastic.lambda, law.elastic.two_shear),
          damping_(stiffness_damping(model.settings) / model.clock.time_step), large_(model.settings.large_strain),
          wet_(!scratch.pressure.empty()), rows_(model, tiles, tile, scratch.pressure), forces_(tile, forces),
          batch_(model, law) {}

    ZoneSums run() {
        Lanes work = Lanes{}, damped = Lanes{};
        const Row whole = cells_in_batch * zones_of_cell;
        for (Row first = tile_.first; first < tile_.last; first += whole) {
            const Row last = std::min(first + whole, tile_.last);
            const Row cells = (last - first) / zones_of_cell;
            batch_.begin(cells);
            read_history(first, cells);
            for (Row z = first; z < last; z += zones_of_group) strain(z, z - first, cells_from(z, last));
            batch_.run(model_);
            write_history(first, cells);
            for (Row z = first; z < last; z += zones_of_group) {
                finish(z, z - first, cells_from(z, last));
                const CellGroup& g = group_at(z - first);
                add_to(work, g.work);
                if (damping_ > 0) add_to(damped, g.damped);
            }
        }
        ZoneSums sums;
        sums.work = kaya::sum(work);
        sums.damped = kaya::sum(damped);
        return sums;
    }

private:
    CellGroup& group_at(Row in_batch) { return groups_[static_cast<std::size_t>(in_batch / zones_of_group)]; }

    void read_history(Row first, Row cells) {
        if (!law_.model->keeps_anything()) return;
        for (Row i = 0; i < cells; ++i) batch_.read_history(i, model_.zones, first + zones_of_cell * i);
    }
    void write_history(Row first, Row cells) {
        if (!law_.model->keeps_anything()) return;
        for (Row z = 0; z < zones_of_cell * cells; ++z)
            batch_.write_history(z / zones_of_cell, model_.zones, first + z);
    }

    double* stresses(Row zone) { return model_.zones.stress[zone].data(); }

    /// Prefetches eight cells while the previous ones are processed.
    [[gnu::always_inline]] void bring_group(Row zone) {
        if (zone + zones_of_group > tile_.last) return;
        if (!kept_.has(tile_.group(zone))) bring(stresses(zone), 6 * zones_of_group);
        for (const auto& column : model_.zones.warp) bring(&column[zone], zones_of_group);
    }

    /// Strains of the step, stresses turned with the material, and warp stresses of the cells.
    void strain(Row zone, Row in_batch, Row cells) {
        CellGroup& g = group_at(in_batch);
        const Row i = in_batch / zones_of_cell;
        bring_group(zone + zones_of_group);
        for (Row l = 0; l < cells; ++l) batch_.number[i + l] = zone + zones_of_cell * l + 1;
        g.corners = rows_.cells_at(zone);
        std::array<Eight, 8> pressures;
        const CellField place = from_first(rows_.places(), g.corners, wet_ ? &pressures : nullptr);
        Eight pressure{};
        if (wet_)
            for (const Eight& p : pressures) pressure += 0.125 * p;
        const CellField shift = from_first(rows_.shifts(), g.corners);
        std::construct_at(&g.shape, place, RuledFaces(rows_.ruled(zone))); // in its place: it is large
        check_cells(model_, zone, cells, place, g.shape);
        const CellMotion motion(g.shape, shift, large_);
        g.half_spin = motion.half_spin;
        g.volume = motion.volume;
        warp(g, motion, zone, cells);

        const Row group = tile_.group(zone);
        const bool kept = kept_.has(group);
        g.apart = !kept && has_initial(model_.zones, zone, cells);
        if (kept) g.before = kept_.of(group);
        else if (g.apart) g.before = mean_of(load_zones(model_.zones.stress, zone, cells));
        else g.before = load_six(stresses(zone), to_next_cell, cells);
        if (large_) {
            g.before = turned(g.before, g.half_spin);
            store_spin(batch_, i, g.half_spin);
        }
        for (std::size_t k = 0; k < 6; ++k) {
            store(batch_.strain[k] + i, motion.strain[k]);
            store(batch_.stress[k] + i, k < 3 ? g.before[k] + pressure : g.before[k]);
        }
        store(batch_.pressure + i, pressure);
        store(batch_.volume + i, motion.volume * (1.0 / zones_of_cell));
    }

    /// Adds the warps of the step.
    [[gnu::always_inline]] void warp(CellGroup& g, const CellMotion& motion, Row zone, Row cells) {
        const WarpStep step(motion);
        const WarpStress change = step.elastic(motion, moduli_);
        load_warps(model_.zones.warp, zone, cells, g.warp);
        g.work = step.work(motion.volume, added(g.warp, 0.5, change));
        g.warp = added(g.warp, 1, change);
        store_warps(model_.zones.warp, zone, cells, g.warp);
        if (damping_ > 0) damp_warps(g, step, change, zone, cells);
    }

    /// Adds the viscous warp stresses of the step to those of the group.
    [[gnu::noinline]] void damp_warps(CellGroup& g, const WarpStep& step, const WarpStress& change, Row zone,
                                      Row cells) {
        WarpStress last;
        load_warps(model_.zones.warp_dashpot, zone, cells, last);
        const WarpStress viscous = added(WarpStress{}, damping_, change);
        g.damped = 0.5 * step.work(g.volume, added(last, 1, viscous));
        store_warps(model_.zones.warp_dashpot, zone, cells, viscous);
        g.warp = added(g.warp, 1, viscous);
    }

    /// The viscous stress of the cells.
    [[gnu::noinline]] SixEights damp(CellGroup& g, Row zone, Row cells, const SixEights& change,
                                     const SixEights& strain) {
        double* const rows = model_.zones.dashpot[zone].data();
        const SixEights last = load_six(rows, to_next_cell, cells);
        SixEights viscous;
        for (std::size_t k = 0; k < 6; ++k) viscous[k] = damping_ * change[k];
        store_six(rows, to_next_cell, cells, viscous, zones_of_cell);
        g.damped += 0.5 * g.volume * product(sum(last, viscous), strain);
        for (Row l = cells; l < eight; ++l) g.damped[l] = 0;
        return viscous;
    }

    /// Writes stresses to the zones and computes their forces and the work of the step.
    void finish(Row zone, Row in_batch, Row cells) {
        CellGroup& g = group_at(in_batch);
        const Row i = in_batch / zones_of_cell;
        const auto column = [&](const double* rows) { return load_as<Eight>(rows + i); };
        SixEights change, strain;
        for (std::size_t k = 0; k < 6; ++k) {
            const Eight before = k < 3 ? g.before[k] + column(batch_.pressure) : g.before[k];
            change[k] = column(batch_.stress[k]) - before;
            strain[k] = column(batch_.strain[k]);
        }
        if (g.apart) {
            finish_apart(g, zone, cells, change, strain);
        } else {
            SixEights after = sum(g.before, change);
            g.work += 0.5 * g.volume * product(sum(g.before, after), strain);
            if (kept_.wanted) kept_.keep(tile_.group(zone), after);
            else store_six(stresses(zone), to_next_cell, cells, after, zones_of_cell);
            if (damping_ > 0) after = sum(after, damp(g, zone, cells, change, strain));
            forces_.add(g.corners, cells, forces_of(g.shape, after, g.warp));
        }
        for (Row l = cells; l < eight; ++l) g.work[l] = 0;
    }

    /// The same for cells with initial stresses.
    void finish_apart(CellGroup& g, Row zone, Row cells, const SixEights& change, const SixEights& strain) {
        SixZones initial = load_zones(model_.zones.initial, zone, cells),
                 stress = load_zones(model_.zones.stress, zone, cells);
        if (large_) {
            turn(initial, g.half_spin);
            turn(stress, g.half_spin);
            store_zones(model_.zones.initial, zone, cells, initial);
        }
        const SixEights before = difference(stress[0], initial[0]);
        for (SixEights& s : stress) s = sum(s, change);
        store_zones(model_.zones.stress, zone, cells, stress);
        SixEights made = difference(stress[0], initial[0]);
        g.work += 0.5 * g.volume * product(sum(before, made), strain);
        if (damping_ > 0) made = sum(made, damp(g, zone, cells, change, strain));
        const InitialForces start(model_, g.shape, from_first(rows_.places(), g.corners),
                                  from_first(rows_.shifts(), g.corners), initial, strain, g.volume, rows_.outer(zone));
        g.work += start.work;
        forces_.add(g.corners, cells, both(forces_of(g.shape, made, g.warp), start.forces));
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    CellStresses& kept_;
    const LayerModuli moduli_;
    const double damping_;
    const bool large_, wet_;
    TileRows rows_;
    TileForces forces_;
    StagedZones<cells_in_batch> batch_;
    std::array<CellGroup, groups_in_batch> groups_;
};

} // namespace

ZoneSums run_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
                   std::vector<PointRow>& forces) {
    return CellRun(model, tiles, tile, law, scratch, forces).run();
}

} // namespace kaya
