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

/// Forces of a stress on the ruled faces of cells.
CellForces forces_on(const RuledFaces& faces, const CellField& place, const SixEights& stress) {
    CellForces forces{};
    if (!std::ranges::all_of(stress, [](const Eight& s) { return all_zero(s); }))
        add_forces(CellShape::of_ruled(place, faces), stress, forces);
    return forces;
}

/// Forces of the ruled faces of cells whose zones have different stresses.
CellForces ruled_forces(const Model& model, const TileRows& rows, const CellField& place, Row zone, Row cells) {
    const RuledFaces faces(rows.ruled(zone));
    if (!faces.any) return {};
    const double* const made = cell_motion(model.zones, zone);
    return forces_on(faces, place, made ? load_six(made, zones_of_cell, cells) : mean_stress(model.zones, zone, cells));
}

/// The stresses of the zones of cells, by zone.
using SixZones = std::array<SixEights, zones_of_cell>;

/// Adds the forces of zones with different stresses. Stresses that change with depth bear the weights of the zones. A corner bears an eighth
/// of its cell instead: the rest, the difference of volume times the divergence of the stresses, is added.
void add_forces_of_zones(const Model& model, const CellField& place, const SixZones& stress, CellForces& forces) {
    std::array<Eight, 8> share{}; // of the volume
    std::array<Eight, zones_of_cell> depth;
    const Vec3& gravity = model.settings.gravity;
    const double size = gravity.norm();
    const Vec3 down = size > 0 ? Vec3(gravity / size) : Vec3::Zero();
    Eight whole{}, mean_depth{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Edges edges = edges_of_zone(place, z);
        add_forces_of_zone(edges, z, stress[z], forces);
        const Eight volume = edges[0].dot(edges[1].cross(edges[2])) * (1.0 / 6);
        for (const std::size_t c : corners_of_zone[z]) share[c] += 0.25 * volume;
        const Eight3 sum = edges[0] + edges[1] + edges[2];
        depth[z] = 0.25 * (sum.x * down.x() + sum.y * down.y() + sum.z * down.z());
        whole += volume;
        mean_depth += depth[z] * (1.0 / zones_of_cell);
    }
    Eight squares{};
    SixEights slope{};
    for (Row z = 0; z < zones_of_cell; ++z) {
        const Eight d = depth[z] - mean_depth;
        squares += d * d;
        for (std::size_t k = 0; k < 6; ++k) slope[k] += d * stress[z][k];
    }
    // Zones at the same depth have no slope.
    const Eight3& far = place[6];
    const Eight over = 1.0 / (squares + 1e-12 * far.dot(far));
    const double x = down.x(), y = down.y(), z = down.z();
    const Eight3 divergence =
        Eight3{slope[0] * x + slope[3] * y + slope[4] * z, slope[3] * x + slope[1] * y + slope[5] * z,
               slope[4] * x + slope[5] * y + slope[2] * z} *
        over;
    for (std::size_t c = 0; c < 8; ++c) forces[c] = forces[c] + divergence * (0.125 * whole - share[c]);
}

/// Forces of the zones of these cells.
CellForces own_forces(const Model& model, const TileRows& rows, const CellField& place, Row zone, Row cells) {
    CellForces forces = ruled_forces(model, rows, place, zone, cells);
    SixZones stress;
    for (Row z = 0; z < zones_of_cell; ++z)
        stress[z] = load_six(model.zones.stress[zone + z].data(), to_next_cell, cells);
    add_forces_of_zones(model, place, stress, forces);
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
        Lanes work = Lanes::Zero(), damped = Lanes::Zero();
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
        check_cells(model_, zone, cells, place, g.shape.least);
        const CellMotion motion(g.shape, shift, large_);
        g.half_spin = motion.half_spin;
        g.volume = motion.volume;
        warp(g, motion, zone, cells);

        const Row group = tile_.group(zone);
        const bool kept = kept_.has(group);
        g.apart = !kept && (model_.zones.keeps_cell_motion || !are_alike(model_.zones.stress, zone, cells));
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

    /// Adds the warps of the step.
    [[gnu::always_inline]] void warp(CellGroup& g, const CellMotion& motion, Row zone, Row cells) {
        const WarpStep step(motion, moduli_);
        load_warps(model_.zones.warp, zone, cells, g.warp);
        g.work = step.work(added(g.warp, 0.5, step.change));
        g.warp = added(g.warp, 1, step.change);
        store_warps(model_.zones.warp, zone, cells, g.warp);
        if (damping_ > 0) damp_warps(g, step, zone, cells);
    }

    /// Adds the viscous warp stresses of the step to those of the group.
    [[gnu::noinline]] void damp_warps(CellGroup& g, const WarpStep& step, Row zone, Row cells) {
        WarpStress last;
        load_warps(model_.zones.warp_dashpot, zone, cells, last);
        const WarpStress viscous = added(WarpStress{}, damping_, step.change);
        g.damped = 0.5 * step.work(added(last, 1, viscous));
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
        SixEights after = sum(g.before, change);
        g.work += 0.5 * g.volume * product(sum(g.before, after), strain);
        if (g.apart) {
            finish_apart(g, zone, cells, change, damping_ > 0 ? damp(g, zone, cells, change, strain) : SixEights{});
        } else {
            if (kept_.wanted) kept_.keep(tile_.group(zone), after);
            else store_six(stresses(zone), to_next_cell, cells, after, zones_of_cell);
            if (damping_ > 0) after = sum(after, damp(g, zone, cells, change, strain));
            forces_.add(g.corners, cells, forces_of(g.shape, after, g.warp));
        }
        for (Row l = cells; l < eight; ++l) g.work[l] = 0;
    }

    /// The same where each zone has its own stress, and ruled faces the stress of the cell's motion.
    void finish_apart(CellGroup& g, Row zone, Row cells, const SixEights& change, const SixEights& viscous) {
        SixEights of_motion = sum(g.before, change);
        if (double* const made = cell_motion(model_.zones, zone)) {
            of_motion = load_six(made, zones_of_cell, cells);
            if (large_) of_motion = turned(of_motion, g.half_spin);
            of_motion = sum(of_motion, change);
            store_six(made, zones_of_cell, cells, of_motion);
        }
        const CellField place = from_first(rows_.places(), g.corners);
        const RuledFaces faces(rows_.ruled(zone));
        CellForces own = faces.any ? forces_on(faces, place, of_motion) : CellForces{};
        SixZones stress;
        for (Row z = 0; z < zones_of_cell; ++z) {
            stress[z] = load_six(stresses(zone + z), to_next_cell, cells);
            if (large_) stress[z] = turned(stress[z], g.half_spin);
            stress[z] = sum(stress[z], change);
            store_six(stresses(zone + z), to_next_cell, cells, stress[z]);
        }
        add_forces_of_zones(model_, place, stress, own);
        // The deviation from the mean stress is constant in the step: its forces are the same before and after.
        CellForces beyond = own;
        SixEights mean = sum(g.before, change);
        for (Eight& s : mean) s *= -1;
        add_forces(g.shape.gradient, mean, beyond);
        const CellField shift = from_first(rows_.shifts(), g.corners);
        for (std::size_t c = 1; c < 8; ++c) g.work -= beyond[c].dot(shift[c - 1]);
        forces_.add(g.corners, cells, both(forces_of(g.shape, viscous, g.warp), own));
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

namespace {

/// Forces of cells that flow, and of the bending that they keep from a time when they were elastic.
CellForces flowing_forces(const Model& model, const TileRows& rows, const CellField& place, Row zone, Row cells) {
    const CellForces own = zones_alone(model, place, zone, cells);
    if (!model.zones.keeps_warps) return own;
    WarpStress held;
    load_warps(model.zones.warp, zone, cells, held);
    if (!resists(held)) return own;
    return both(own, forces_of(CellShape(place, RuledFaces(rows.ruled(zone))), SixEights{}, held));
}

/// Forces of cells whose zones strain together.
CellForces elastic_forces(const Model& model, const TileRows& rows, const CellField& place, Row zone, Row cells) {
    const Zones& zones = model.zones;
    const CellShape shape(place, RuledFaces(rows.ruled(zone)));
    WarpStress warp;
    load_warps(zones.warp, zone, cells, warp);
    SixEights viscous{};
    if (zones_are_damped(model)) {
        viscous = load_six(zones.dashpot[zone].data(), to_next_cell, cells);
        if (zones.keeps_warp_dashpots) { // not before the first step
            WarpStress more;
            load_warps(zones.warp_dashpot, zone, cells, more);
            warp = added(warp, 1, more);
        }
    }
    if (zones.keeps_cell_motion || !are_alike(zones.stress, zone, cells))
        return both(forces_of(shape, viscous, warp), own_forces(model, rows, place, zone, cells));
    return forces_of(shape, sum(load_six(zones.stress[zone].data(), to_next_cell, cells), viscous), warp);
}

} // namespace

void cell_forces(const Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 std::vector<PointRow>& forces) {
    const TileRows rows(model, tiles, tile);
    TileForces sums(tile, forces);
    const auto of_cells = law.together == Together::flow_in_cells ? flowing_forces : elastic_forces;
    for (Row zone = tile.first; zone < tile.last; zone += zones_of_group) {
        const Row cells = cells_from(zone, tile.last);
        const CellGroupCorners corners = rows.cells_at(zone);
        sums.add(corners, cells, of_cells(model, rows, from_first(rows.places(), corners), zone, cells));
    }
}

} // namespace kaya
