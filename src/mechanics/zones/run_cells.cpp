#include "mechanics/zones/run_cells.hpp"

#include "mechanics/zones/cell_motion.hpp"
#include "mechanics/zones/cells.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/staged_zones.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace kaya {

namespace {

constexpr Row cells_in_batch = 32;
constexpr std::size_t groups_in_batch = cells_in_batch / eight;

/// Throws where a zone has no volume left. `least` is the volume of the smallest zone of each cell, or a multiple.
void check_cells(const Model& model, Row zone, Row cells, const CellField& x, const Eight& least) {
    if (all_above_zero(least)) return;
    for (Row z = 0; z < zones_of_cell; ++z)
        check_volumes(model, zone + z, zones_of_cell, cells, FaceAreas(edges_of_zone(x, z)).six_volumes);
}

/// Whether all zones of each cell have the same stress, by comparing each component with the zone before.
bool are_alike(const Column<Stress>& stresses, Row zone, Row cells) {
    bool alike = true;
    for (Row l = 0; l < cells; ++l) {
        const double* const first = stresses[zone + zones_of_cell * l].data();
        for (const std::size_t k : {0, 8, 16, 22}) // the last two overlap: there are thirty
            alike &= all_equal(load_as<Eight>(first + k), load_as<Eight>(first + k + 6));
    }
    return alike;
}

/// The stress of the zones of each cell, in the mean.
SixEights mean_stress(const Zones& zones, Row zone, Row cells) {
    const auto stress = [&](Row z) { return load_six(zones.stress[zone + z].data(), to_next_cell, cells); };
    SixEights mean = stress(0);
    for (Row z = 1; z < zones_of_cell; ++z) mean = sum(mean, stress(z));
    for (Eight& s : mean) s *= 1.0 / zones_of_cell;
    return mean;
}

/// Prefetches numbers that will be written. Inlined: compilers drop calls of functions without visible effect.
[[gnu::always_inline]] inline void bring(const double* first, Row count) {
    for (Row i = 0; i < count; i += eight) __builtin_prefetch(first + i, 1);
}

CellForces both(const CellForces& a, const CellForces& b) {
    CellForces forces;
    for (std::size_t c = 0; c < 8; ++c) forces[c] = a[c] + b[c];
    return forces;
}

/// Forces of a stress on the ruled faces of cells.
CellForces forces_on(const RuledFaces& faces, const CellField& place, const SixEights& stress) {
    CellForces forces{};
    if (!std::ranges::all_of(stress, [](const Eight& s) { return all_zero(s); }))
        add_forces(CellShape::of_ruled(place, faces), stress, forces);
    return forces;
}

/// Forces of the ruled faces of cells whose zones have different stresses.
CellForces ruled_forces(const Model& model, const TileRows& rows, const ZoneLaw& law, const CellField& place, Row zone,
                        Row cells) {
    const RuledFaces faces(rows.ruled(zone));
    if (!faces.any) return {};
    const double* const made = cell_motion(model.zones, law, zone);
    return forces_on(faces, place, made ? load_six(made, zones_of_cell, cells) : mean_stress(model.zones, zone, cells));
}

/// Up to eight cells as they are.
struct CellGroupView {
    Row cells;
    CellGroupCorners corners;
    CellField place;
    CellShape shape;
    WarpStress warp;

    [[gnu::always_inline]] CellGroupView(const Model& model, const TileRows& rows, const ZoneTile& tile,
                                         const ZoneLaw& law, Row zone)
        : cells(cells_from(zone, tile.last)), corners(rows.cells_at(zone)), place(from_first(rows.places(), corners)),
          shape(place, RuledFaces(rows.ruled(zone))) {
        load_warps(model.zones, law.cell_history, zone, cells, warp);
    }

    /// Of the warp stresses alone.
    CellForces of_warp() const { return forces_of(shape, SixEights{}, warp); }
};

/// Forces of the zones of these cells.
CellForces own_forces(const Model& model, const TileRows& rows, const ZoneLaw& law, const CellGroupView& g, Row zone) {
    CellForces forces = ruled_forces(model, rows, law, g.place, zone, g.cells);
    for (Row z = 0; z < zones_of_cell; ++z)
        add_forces_of_zone(edges_of_zone(g.place, z), z,
                           load_six(model.zones.stress[zone + z].data(), to_next_cell, g.cells), forces);
    return forces;
}

/// Forces of the zones of flowing cells.
CellForces zones_alone(const Model& model, const CellField& place, Row zone, Row cells) {
    const bool damped = zones_are_damped(model);
    CellForces forces{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        SixEights stress = load_six(model.zones.stress[zone + z].data(), to_next_cell, cells);
        if (damped) stress = sum(stress, load_six(model.zones.dashpot[zone + z].data(), to_next_cell, cells));
        add_forces_of_zone(edges_of_zone(place, z), z, stress, forces);
    }
    return forces;
}

/// Per-group data kept until the stresses are updated.
struct CellGroup {
    CellGroupCorners corners;
    CellShape shape;  ///< at the end of the step
    bool apart;       ///< the zones have different stresses, or the stress of the cell's motion differs from them
    SixEights before; ///< the common stress of the zones, or their mean, turned with the cell
    Eight3 half_spin;
    Eight volume, work; ///< in the middle of the step; of warping
    WarpStress warp;
};

/// Each cell is a row for the zone model. Its history is that of the first zone, and is then copied to all.
class CellRun {
public:
    CellRun(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
            std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(law), kept_(scratch.cells),
          moduli_(law.elastic.lambda, law.elastic.two_shear), large_(model.settings.large_strain),
          wet_(!scratch.pressure.empty()), rows_(model, tiles, tile, scratch.pressure), forces_(tile, forces),
          batch_(model, law) {}

    double run() {
        Lanes work = Lanes::Zero();
        const Row whole = cells_in_batch * zones_of_cell;
        for (Row first = tile_.first; first < tile_.last; first += whole) {
            const Row last = std::min(first + whole, tile_.last);
            const Row cells = (last - first) / zones_of_cell;
            batch_.begin(cells);
            read_history(first, cells);
            for (Row z = first; z < last; z += zones_of_group) strain(z, z - first, cells_from(z, last));
            batch_.run(model_);
            write_history(first, cells);
            for (Row z = first; z < last; z += zones_of_group) add_to(work, finish(z, z - first, cells_from(z, last)));
        }
        return kaya::sum(work);
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
        for (const std::size_t column : {law_.cell_history, law_.cell_history + 1})
            bring(&model_.zones.history[column][zone], zones_of_group);
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
        check_cells(model_, zone, cells, place, g.shape.least);
        const CellMotion motion(g.shape, shift, large_);
        g.half_spin = motion.half_spin;
        g.volume = motion.volume;
        load_warps(model_.zones, law_.cell_history, zone, cells, g.warp);
        g.work = add_warp_stress(motion, moduli_, g.warp);
        store_warps(model_.zones, law_.cell_history, zone, cells, g.warp);

        const Row group = tile_.group(zone);
        const bool kept = kept_.has(group);
        g.apart = !kept && (keeps_cell_motion(model_.zones, law_) || !are_alike(model_.zones.stress, zone, cells));
        if (kept) g.before = kept_.of(group);
        else if (g.apart) g.before = mean_stress(model_.zones, zone, cells);
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

    /// Writes stresses to the zones and computes their forces. Returns the work of the step, by cell.
    Eight finish(Row zone, Row in_batch, Row cells) {
        CellGroup& g = group_at(in_batch);
        const Row i = in_batch / zones_of_cell;
        const auto column = [&](const double* rows) { return load_as<Eight>(rows + i); };
        SixEights change, strain;
        for (std::size_t k = 0; k < 6; ++k) {
            const Eight before = k < 3 ? g.before[k] + column(batch_.pressure) : g.before[k];
            change[k] = column(batch_.stress[k]) - before;
            strain[k] = column(batch_.strain[k]);
        }
        const SixEights after = sum(g.before, change);
        g.work += 0.5 * g.volume * product(sum(g.before, after), strain);
        if (g.apart) {
            finish_apart(g, zone, cells, change);
        } else {
            if (kept_.wanted) kept_.keep(tile_.group(zone), after);
            else store_six(stresses(zone), to_next_cell, cells, after, zones_of_cell);
            forces_.add(g.corners, cells, forces_of(g.shape, after, g.warp));
        }
        for (Row l = cells; l < eight; ++l) g.work[l] = 0;
        return g.work;
    }

    /// The same where each zone has its own stress, and ruled faces the stress of the cell's motion.
    void finish_apart(CellGroup& g, Row zone, Row cells, const SixEights& change) {
        SixEights of_motion = sum(g.before, change);
        if (double* const made = cell_motion(model_.zones, law_, zone)) {
            of_motion = load_six(made, zones_of_cell, cells);
            if (large_) of_motion = turned(of_motion, g.half_spin);
            of_motion = sum(of_motion, change);
            store_six(made, zones_of_cell, cells, of_motion);
        }
        const CellField place = from_first(rows_.places(), g.corners);
        const RuledFaces faces(rows_.ruled(zone));
        CellForces own = faces.any ? forces_on(faces, place, of_motion) : CellForces{};
        for (Row z = 0; z < zones_of_cell; ++z) {
            SixEights stress = load_six(stresses(zone + z), to_next_cell, cells);
            if (large_) stress = turned(stress, g.half_spin);
            stress = sum(stress, change);
            store_six(stresses(zone + z), to_next_cell, cells, stress);
            add_forces_of_zone(edges_of_zone(place, z), z, stress, own);
        }
        // The deviation from the mean stress is constant in the step: its forces are the same before and after.
        CellForces beyond = own;
        SixEights mean = sum(g.before, change);
        for (Eight& s : mean) s *= -1;
        add_forces(g.shape.gradient, mean, beyond);
        const CellField shift = from_first(rows_.shifts(), g.corners);
        for (std::size_t c = 1; c < 8; ++c) g.work -= beyond[c].dot(shift[c - 1]);
        forces_.add(g.corners, cells, both(forces_of(g.shape, SixEights{}, g.warp), own));
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    CellStresses& kept_;
    const LayerModuli moduli_;
    const bool large_, wet_;
    TileRows rows_;
    TileForces forces_;
    StagedZones<cells_in_batch> batch_;
    std::array<CellGroup, groups_in_batch> groups_;
};

} // namespace

bool cells_go_together(const Settings& settings) {
    return !settings.dynamic && settings.damping != Damping::none && settings.damping != Damping::rayleigh;
}

ZoneSums run_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law, ZoneScratch& scratch,
                   std::vector<PointRow>& forces) {
    ZoneSums sums;
    sums.work = CellRun(model, tiles, tile, law, scratch, forces).run();
    return sums;
}

void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces) {
    const TileRows rows(model, tiles, tile);
    TileForces sums(tile, forces);
    const bool together = law.together == Together::cells, kept = keeps_cell_motion(model.zones, law);
    for (Row zone = tile.first; zone < tile.last; zone += zones_of_group) {
        if (!together) {
            const Row cells = cells_from(zone, tile.last);
            const CellGroupCorners corners = rows.cells_at(zone);
            sums.add(corners, cells, zones_alone(model, from_first(rows.places(), corners), zone, cells));
            continue;
        }
        const CellGroupView g(model, rows, tile, law, zone);
        if (kept || !are_alike(model.zones.stress, zone, g.cells))
            sums.add(g.corners, g.cells, both(g.of_warp(), own_forces(model, rows, law, g, zone)));
        else
            sums.add(g.corners, g.cells,
                     forces_of(g.shape, load_six(model.zones.stress[zone].data(), to_next_cell, g.cells), g.warp));
    }
}

double hold_cells(Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law, TileForces& forces) {
    const bool large = model.settings.large_strain;
    Lanes whole = Lanes::Zero();
    for (Row z = tile.first; z < tile.last; z += zones_of_group) {
        CellGroupView g(model, rows, tile, law, z);
        const CellField shift = from_first(rows.shifts(), g.corners);
        const CellMotion motion(g.shape, shift, large);
        Eight work = add_warp_stress(motion, LayerModuli(), g.warp);
        double* const made = cell_motion(model.zones, law, z);
        if (large)
            store_six(made, zones_of_cell, g.cells, turned(load_six(made, zones_of_cell, g.cells), motion.half_spin));
        const CellForces ruled = ruled_forces(model, rows, law, g.place, z, g.cells);
        for (std::size_t c = 1; c < 8; ++c) work -= ruled[c].dot(shift[c - 1]);
        for (Row l = g.cells; l < eight; ++l) work[l] = 0;
        add_to(whole, work);
        forces.add(g.corners, g.cells, both(g.of_warp(), ruled));
    }
    return sum(whole);
}

void held_forces(const Model& model, const TileRows& rows, const ZoneTile& tile, const ZoneLaw& law,
                 TileForces& forces) {
    for (Row z = tile.first; z < tile.last; z += zones_of_group) {
        const CellGroupView g(model, rows, tile, law, z);
        forces.add(g.corners, g.cells, both(g.of_warp(), ruled_forces(model, rows, law, g.place, z, g.cells)));
    }
}

} // namespace kaya
