#include "mechanics/zones/run_flowing_cells.hpp"

#include "mechanics/zones/cells.hpp"
#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/staged_zones.hpp"

#include <algorithm>
#include <array>

namespace kaya {

namespace {

constexpr Row groups_in_batch = 2;

SixEights deviator(const SixEights& stress) {
    const Eight mean = (stress[0] + stress[1] + stress[2]) / 3.0;
    SixEights s = stress;
    for (std::size_t k = 0; k < 3; ++k) s[k] -= mean;
    return s;
}

/// Per-group data kept until the stresses are updated.
struct FlowGroup {
    CellGroupCorners corners;
    CellField place;
    Eight mean_strain;                                      ///< of volume
    std::array<Eight, zones_of_cell> volume, volume_strain; ///< of each zone
    std::array<SixEights, zones_of_cell> before;            ///< stress, turned with the zone
};

/// Rows for the zone model are zones: eight at a time, the same one of each cell.
class FlowingCells {
public:
    FlowingCells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 const std::vector<double>& pressure, std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(law), bulk_(law.elastic.lambda + law.elastic.two_shear / 3),
          damping_(stiffness_damping(model.settings) / model.clock.time_step), large_(model.settings.large_strain),
          wet_(!pressure.empty()), averages_(model.settings.mixed_discretisation), bent_(model.zones.keeps_warps),
          rows_(model, tiles, tile, pressure), forces_(tile, forces), batch_(model, law) {}

    ZoneSums run() {
        const Row whole = groups_in_batch * zones_of_group;
        for (Row first = tile_.first; first < tile_.last; first += whole) {
            const Row last = std::min(first + whole, tile_.last);
            batch_.begin(last - first);
            for (Row z = first; z < last; z += zones_of_group) strain(place(z, first, last));
            batch_.run(model_);
            for (Row z = first; z < last; z += zones_of_group) finish(place(z, first, last));
        }
        ZoneSums sums;
        sums.work = kaya::sum(work_);
        sums.damped = kaya::sum(damped_work_);
        return sums;
    }

private:
    /// Up to eight cells and their rows.
    struct Place {
        Row row(Row z) const { return first_row + z * cells; } ///< of zone z of the first cell
        Row zone, first_row, cells;
    };
    static Place place(Row zone, Row first, Row last) { return {zone, zone - first, cells_from(zone, last)}; }
    FlowGroup& group_at(const Place& at) { return groups_[static_cast<std::size_t>(at.first_row / zones_of_group)]; }

    double* stresses(Row zone) { return model_.zones.stress[zone].data(); }
    /// The change by averaging over the cell: none with `zone nmd off`.
    Eight averaged(const Eight& change) const { return averages_ ? change : Eight{}; }

    /// Strains of the step, and the stresses turned with the material.
    [[gnu::always_inline]] void strain(const Place& at) {
        FlowGroup& g = group_at(at);
        g.corners = rows_.cells_at(at.zone);
        std::array<Eight, 8> pressures;
        g.place = from_first(rows_.places(), g.corners, &pressures);
        const CellField shift = from_first(rows_.shifts(), g.corners);
        std::array<SixEights, zones_of_cell> strains;
        Eight grown{}, whole{};
        for (Row z = 0; z < zones_of_cell; ++z) {
            const Deformation d(edges_of_zone(g.place, z), edges_of_zone(shift, z), large_);
            check_volumes(model_, at.zone + z, zones_of_cell, at.cells, d.volume);
            g.volume[z] = d.volume;
            g.volume_strain[z] = d.volume_strain;
            grown += d.volume * d.volume_strain;
            whole += d.volume;
            strains[z] = d.strain;
            g.before[z] = load_six(stresses(at.zone + z), to_next_cell, at.cells);
            if (!large_) continue;
            g.before[z] = turned(g.before[z], d.half_spin);
            store_spin(batch_, at.row(z), d.half_spin);
        }
        g.mean_strain = grown / whole;
        for (Row z = 0; z < zones_of_cell; ++z) {
            const Eight more = averaged((g.mean_strain - g.volume_strain[z]) / 3.0);
            for (std::size_t k = 0; k < 3; ++k) strains[z][k] += more;
            Eight pressure{};
            if (wet_)
                for (const std::size_t c : corners_of_zone[z]) pressure += 0.25 * pressures[c];
            fill_rows(at, z, g, strains[z], pressure);
        }
        read_history(at);
    }

    void fill_rows(const Place& at, Row z, const FlowGroup& g, const SixEights& strain, const Eight& pressure) {
        const Row row = at.row(z);
        const auto put = [&](double* column, const Eight& value) { store_rows(column + row, at.cells, value); };
        for (std::size_t k = 0; k < 6; ++k) {
            put(batch_.strain[k], strain[k]);
            put(batch_.stress[k], k < 3 ? g.before[z][k] + pressure : g.before[z][k]);
        }
        put(batch_.volume, g.volume[z]);
        put(batch_.pressure, pressure);
    }

    void read_history(const Place& at) {
        const Zones& zones = model_.zones;
        for (Row z = 0; z < zones_of_cell; ++z)
            for (Row l = 0; l < at.cells; ++l) {
                const Row zone = at.zone + zones_of_cell * l + z;
                batch_.state[at.row(z) + l] = zones.state[zone];
                batch_.number[at.row(z) + l] = zone + 1;
            }
        for (std::size_t k = 0; k < law_.model->history.size(); ++k) {
            const SixEights kept = load_six(&zones.history[k][at.zone], 6, at.cells);
            for (Row z = 0; z < zones_of_cell; ++z) store_rows(batch_.history[k] + at.row(z), at.cells, kept[z]);
        }
    }
    void write_history(const Place& at) {
        Zones& zones = model_.zones;
        for (Row z = 0; z < zones_of_cell; ++z)
            for (Row l = 0; l < at.cells; ++l)
                zones.state[at.zone + zones_of_cell * l + z] = batch_.state[at.row(z) + l];
        for (std::size_t k = 0; k < law_.model->history.size(); ++k) {
            SixEights kept;
            for (Row z = 0; z < zones_of_cell; ++z) kept[z] = load_rows(batch_.history[k] + at.row(z), at.cells);
            store_six(&zones.history[k][at.zone], 6, at.cells, kept);
        }
    }

    /// Writes stresses to the zones, updates their state, and computes their forces.
    void finish(const Place& at) {
        FlowGroup& g = group_at(at);
        write_history(at);
        std::array<SixEights, zones_of_cell> stress, strain;
        std::array<Eight, zones_of_cell> flow; // plastic change of the mean stress
        Eight flowed{}, whole{}, work{}, damped{};
        Eight remains{}, elastic{}; // squares of deviators, and without flow
        for (Row z = 0; z < zones_of_cell; ++z) {
            const auto column = [&](const double* rows) { return load_rows(rows + at.row(z), at.cells); };
            const Eight pressure = wet_ ? column(batch_.pressure) : Eight{};
            for (std::size_t k = 0; k < 6; ++k) {
                stress[z][k] = k < 3 ? column(batch_.stress[k]) - pressure : column(batch_.stress[k]);
                strain[z][k] = column(batch_.strain[k]);
            }
            const SixEights &before = g.before[z], &after = stress[z];
            flow[z] =
                (after[0] - before[0] + after[1] - before[1] + after[2] - before[2]) / 3.0 - bulk_ * g.mean_strain;
            flowed += g.volume[z] * flow[z];
            if (bent_) {
                const SixEights trial = elastic_trial(before, strain[z]);
                remains += product(deviator(after), deviator(after));
                elastic += product(deviator(trial), deviator(trial));
            }
            whole += g.volume[z];
        }
        const Eight mean_flow = flowed / whole;
        CellForces forces;
        forces.fill({Eight{}, Eight{}, Eight{}});
        for (Row z = 0; z < zones_of_cell; ++z) {
            const Eight more = averaged(mean_flow - flow[z]);
            SixEights& after = stress[z];
            if (damping_ > 0) damped += g.volume[z] * damp(at, z, g.before[z], after, strain[z]);
            for (std::size_t k = 0; k < 3; ++k) after[k] += more;
            // The forces act on the zone's own deformation.
            const SixEights both = sum(g.before[z], after);
            const Eight own = averaged((g.volume_strain[z] - g.mean_strain) / 3.0);
            work += g.volume[z] * (product(both, strain[z]) + (both[0] + both[1] + both[2]) * own);
            store_six(stresses(at.zone + z), to_next_cell, at.cells, after);
            if (damping_ > 0) after = sum(after, load_six(dashpots(at.zone + z), to_next_cell, at.cells));
            add_forces_of_zone(edges_of_zone(g.place, z), z, after, forces);
        }
        if (bent_) forces = both(forces, held(at, remains / elastic, work));
        forces_.add(g.corners, at.cells, forces);
        for (Row l = at.cells; l < eight; ++l) work[l] = damped[l] = 0;
        add_to(work_, 0.5 * work);
        add_to(damped_work_, 0.5 * damped);
    }

    SixEights elastic_trial(const SixEights& before, const SixEights& strain) const {
        const auto& [lambda, two_shear] = law_.elastic;
        const Eight mean = lambda * (strain[0] + strain[1] + strain[2]);
        SixEights stress;
        for (std::size_t k = 0; k < 6; ++k) stress[k] = before[k] + two_shear * strain[k] + (k < 3 ? mean : Eight{});
        return stress;
    }

    /// Forces of warp stresses from a time when the cells were elastic. They remain until the zones flow, and are then reduced as the
    /// squares of their deviators are.
    [[gnu::noinline]] CellForces held(const Place& at, const Eight& part, Eight& work) {
        WarpStress warp;
        load_warps(model_.zones.warp, at.zone, at.cells, warp);
        if (!resists(warp)) return {};
        const Eight kept = part < 1 - 1e-12 ? part : eights(1);
        for (Eight& s : warp) s *= kept;
        store_warps(model_.zones.warp, at.zone, at.cells, warp);
        const FlowGroup& g = group_at(at);
        const CellField shift = from_first(rows_.shifts(), g.corners);
        const CellForces forces = forces_of(CellShape(g.place, RuledFaces(rows_.ruled(at.zone))), SixEights{}, warp);
        for (std::size_t c = 1; c < 8; ++c) work -= 2.0 * forces[c].dot(shift[c - 1]);
        return forces;
    }

    double* dashpots(Row zone) { return model_.zones.dashpot[zone].data(); }

    /// Adds viscous stresses. Returns the energy they dissipate, twice and per volume.
    Eight damp(const Place& at, Row z, const SixEights& before, const SixEights& after, const SixEights& strain) {
        double* const rows = dashpots(at.zone + z);
        const SixEights last = load_six(rows, to_next_cell, at.cells);
        SixEights viscous;
        for (std::size_t k = 0; k < 6; ++k) viscous[k] = damping_ * (after[k] - before[k]);
        store_six(rows, to_next_cell, at.cells, viscous);
        return product(sum(last, viscous), strain);
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    const double bulk_, damping_;
    const bool large_, wet_, averages_, bent_; ///< the last: cells may have been elastic and bent
    TileRows rows_;
    TileForces forces_;
    StagedZones<groups_in_batch * zones_of_group> batch_;
    std::array<FlowGroup, groups_in_batch> groups_;
    Lanes work_ = Lanes::Zero(), damped_work_ = Lanes::Zero();
};

} // namespace

ZoneSums run_flowing_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                           const std::vector<double>& pressure, std::vector<PointRow>& forces) {
    return FlowingCells(model, tiles, tile, law, pressure, forces).run();
}

} // namespace kaya
