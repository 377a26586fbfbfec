#include "mechanics/zones/run_flowing_cells.hpp"

#include "mechanics/contact/dashpots.hpp"
#include "mechanics/zones/cell_forces.hpp"
#include "mechanics/zones/staged_zones.hpp"
#include "mechanics/zones/viscous_stress.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace kaya {

namespace {

/// Of layers, over their strain: the ratio of the principal strains of plastic flow, (1 + sin psi)/(1 - sin psi), with a dilation of 42 degrees. A
/// limit keeps layers that are not strained themselves from breaking one by one.
constexpr double most_thickening = 5;

Eight square_of_deviator(const SixEights& stress) {
    const Eight mean = mean_of_three(stress);
    return product(stress, stress) - 3.0 * mean * mean;
}

/// A number, or the nearer limit where it is beyond. `square` is that of the limits; their root is computed where it is needed.
[[gnu::always_inline]] inline Eight within_root(const Eight& square, const Eight& number) {
    const MaskOfEight inside = number * number <= square;
    if (all(inside)) return number;
    const Eight limit = square_root(square);
    return inside ? number : number < 0 ? -limit : limit;
}

/// Numbers of the zones of a group in the order of its rows: the same zone of each cell, then the next one; from 1.
constexpr std::array<Row, zones_of_group> number_in_group = [] {
    std::array<Row, zones_of_group> number{};
    for (std::size_t i = 0; i < number.size(); ++i)
        number[i] = static_cast<Row>(i % eight * zones_of_cell + i / eight + 1);
    return number;
}();

constexpr Row groups_in_batch = 2; ///< their data remain in the first-level cache

/// Data of eight cells kept until their stresses are updated.
struct FlowGroup {
    bool blank; ///< states and histories are 0
    CellGroupCorners corners;
    CellShape shape; ///< at the end of the step
    LayerPlanes planes;
    SixEights strain;
    WarpStep warp;
    WarpStress kept;          ///< the columns of warps: FlowingCells
    Eight volume;             ///< in the middle of the step
    Eight work;               ///< twice that of the stresses before the step, apart from fibres
    SixZones before, initial; ///< stresses, turned with the cell
    bool has_initial;
};

/// Rows for the zone model are zones: eight at a time, the same one of each cell. Of the twelve columns of warps three hold how much thicker
/// layers became beyond the elastic part, and the last three the stresses of fibres.
class FlowingCells {
public:
    FlowingCells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                 const std::vector<double>& pressure, std::vector<PointRow>& forces)
        : model_(model), tile_(tile), law_(law), young_(LayerModuli(law.elastic.lambda, law.elastic.two_shear).young),
          damping_(stiffness_damping(model.settings) / model.clock.time_step), large_(model.settings.large_strain),
          wet_(!pressure.empty()), averages_(model.settings.mixed_discretisation), rows_(model, tiles, tile, pressure),
          forces_(tile, forces), batch_(model, law) {}

    ZoneSums run() {
        constexpr Row whole = groups_in_batch * zones_of_group;
        for (Row first = tile_.first; first < tile_.last; first += whole) {
            const Row count = std::min(whole, tile_.last - first);
            batch_.begin(count);
            for_groups(
                first, count, [this](const Place& at) __attribute__((always_inline)) { strain(at); });
            batch_.run(model_);
            for_groups(
                first, count, [this](const Place& at) __attribute__((always_inline)) { finish(at); });
        }
        ZoneSums sums;
        sums.work = kaya::sum(work_);
        sums.damped = kaya::sum(damped_work_);
        return sums;
    }

private:
    /// Up to eight cells and their rows.
    struct Place {
        [[gnu::always_inline]] Row row(Row z) const { return first_row + z * cells; } ///< of zone z of the first cell
        Row zone, cells, first_row;
    };

    /// Calls each(place) for the groups of a batch. With eight cells, a number that the compiler sees, no loop over rows remains.
    template <class Each> [[gnu::always_inline]] static void for_groups(Row first, Row count, Each each) {
        Row row = 0;
        for (; row + zones_of_group <= count; row += zones_of_group) whole_group(each, {first + row, eight, row});
        if (row < count) part_of_group(each, {first + row, (count - row) / zones_of_cell, row});
    }
    template <class Each> [[gnu::always_inline]] static void whole_group(Each each, Place at) {
        at.cells = eight;
        each(at);
    }
    template <class Each> [[gnu::noinline]] static void part_of_group(Each each, const Place& at) { each(at); }

    FlowGroup& group_at(const Place& at) { return groups_[static_cast<std::size_t>(at.first_row / zones_of_group)]; }

    /// Strains of the step, and the stresses turned with the material.
    [[gnu::always_inline]] void strain(const Place& at) {
        FlowGroup& g = group_at(at);
        const bool another = at.zone + 2 * zones_of_group <= tile_.last;
        g.corners = rows_.cells_at(at.zone);
        std::array<Eight, 8> pressures;
        const CellField place = from_first(rows_.places(), g.corners, wet_ ? &pressures : nullptr);
        std::construct_at(&g.shape, place, RuledFaces(rows_.ruled(at.zone))); // in its place: it is large
        check_cells(model_, at.zone, at.cells, place, g.shape);
        const CellMotion motion(g.shape, from_first(rows_.shifts(), g.corners), large_);
        std::construct_at(&g.warp, motion);
        for (std::size_t a = 0; a < 3; ++a) std::construct_at(&g.planes[a], g.shape.axis, a, law_.elastic);
        g.strain = motion.strain;
        g.volume = motion.volume;
        load_warps(model_.zones.warp, at.zone, at.cells, g.kept);
        g.has_initial = has_initial(model_.zones, at.zone, at.cells);
        if (g.has_initial) load_initial(g, at, motion.half_spin);
        for (Row z = 0; z < zones_of_cell; ++z) {
            Eight pressure{};
            if (wet_)
                for (const std::size_t c : corners_of_zone[z]) pressure += 0.25 * pressures[c];
            if (another) bring_part(at.zone + zones_of_group, z);
            fill_rows(at, z, g, motion.half_spin, pressure);
        }
        fill_strains(at, g);
        read_history(at, g);
    }

    /// Prefetches a sixth of eight cells while the previous ones are processed.
    [[gnu::always_inline]] void bring_part(Row zone, Row part) {
        const Row first = zone + part * eight;
        bring(model_.zones.stress[first].data(), 6 * eight);
        for (const auto& column : model_.zones.warp) bring(&column[first], eight);
        for (std::size_t k = 0; k < law_.model->history.size(); ++k)
            __builtin_prefetch(&model_.zones.history[k][first]);
        if (part % 2 == 0) __builtin_prefetch(&model_.zones.state[first]);
    }

    [[gnu::noinline]] void load_initial(FlowGroup& g, const Place& at, const Eight3& half_spin) {
        g.initial = load_zones(model_.zones.initial, at.zone, at.cells);
        if (!large_) return;
        turn(g.initial, half_spin);
        store_zones(model_.zones.initial, at.zone, at.cells, g.initial);
    }

    [[gnu::always_inline]] void put(double* column, const Place& at, Row z, const Eight& value) {
        store_rows(column + at.row(z), at.cells, value);
    }

    /// Rows of one zone, but for their strains.
    [[gnu::always_inline]] void fill_rows(const Place& at, Row z, FlowGroup& g, const Eight3& half_spin,
                                          const Eight& pressure) {
        SixEights stress = load_six(model_.zones.stress[at.zone + z].data(), to_next_cell, at.cells);
        if (large_) {
            stress = turned(stress, half_spin);
            store_spin(batch_, at.row(z), half_spin);
        }
        g.before[z] = stress;
        for (std::size_t k = 0; k < 6; ++k)
            put(batch_.stress[k], at, z, wet_ && k < 3 ? stress[k] + pressure : stress[k]);
        put(batch_.volume, at, z, g.volume * (1.0 / zones_of_cell));
        if (wet_) put(batch_.pressure, at, z, pressure);
    }

    /// Of the part of stresses beyond the initial ones.
    [[gnu::always_inline]] static MadeStress made(const FlowGroup& g, const SixZones& stress) {
        return g.has_initial ? made_beyond(g, stress) : made_stress(g.planes, stress);
    }
    [[gnu::noinline]] static MadeStress made_beyond(const FlowGroup& g, const SixZones& stress) {
        return made_stress(g.planes, difference(stress, g.initial));
    }

    /// Layers change their thickness such that no stress goes from one to the next: equation (13).
    [[gnu::always_inline]] void fill_strains(const Place& at, FlowGroup& g) {
        const double softness = 1 / (law_.elastic.lambda + law_.elastic.two_shear);
        SixEights mean = mean_of(g.before);
        if (g.has_initial) mean = difference(mean, mean_of(g.initial));
        Eight of_layers{};
        for (std::size_t a = 0; a < 3; ++a) {
            const LayerPlane& plane = g.planes[a];
            SixEights layer = plane.strain(&g.warp.strain[3 * a]);
            SixEights pressed = layer_stress(g.before, a);
            if (g.has_initial) pressed = difference(pressed, layer_stress(g.initial, a));
            const Eight wanted = product(pressed, plane.across) * -softness;
            of_layers += product(pressed, layer);
            const Eight most = most_thickening * most_thickening * product(layer, layer);
            const Eight thicker = within_root(most, g.kept[a] + wanted);
            g.kept[a] = within_root(most, g.kept[a] + 0.25 * wanted);
            for (std::size_t k = 0; k < 6; ++k) {
                layer[k] += thicker * plane.across[k];
                put(batch_.strain[k], at, layer_zones[a].upper, g.strain[k] + layer[k]);
                put(batch_.strain[k], at, layer_zones[a].lower, g.strain[k] - layer[k]);
            }
        }
        g.work = g.volume * (product(mean, g.strain) + of_layers * (1.0 / 3));
    }

    [[gnu::always_inline]] void read_history(const Place& at, FlowGroup& g) {
        const Zones& zones = model_.zones;
        const std::size_t columns = law_.model->history.size();
        for (Row z = 0; z < zones_of_cell; ++z)
            for (Row l = 0; l < at.cells; ++l) batch_.number[at.row(z) + l] = at.zone + number_in_group[z * eight + l];
        const Row count = zones_of_cell * at.cells;
        g.blank = all_zero_rows(&zones.state[at.zone], count);
        for (std::size_t k = 0; k < columns; ++k) g.blank &= all_zero_rows(&zones.history[k][at.zone], count);
        if (g.blank) {
            std::fill_n(batch_.state + at.first_row, count, 0u);
            for (std::size_t k = 0; k < columns; ++k) std::fill_n(batch_.history[k] + at.first_row, count, 0.0);
            return;
        }
        for (Row z = 0; z < zones_of_cell; ++z)
            for (Row l = 0; l < at.cells; ++l)
                batch_.state[at.row(z) + l] = zones.state[at.zone + zones_of_cell * l + z];
        for (std::size_t k = 0; k < columns; ++k) {
            const SixEights kept = load_six(&zones.history[k][at.zone], 6, at.cells);
            for (Row z = 0; z < zones_of_cell; ++z) store_rows(batch_.history[k] + at.row(z), at.cells, kept[z]);
        }
    }
    [[gnu::always_inline]] void write_history(const Place& at, const FlowGroup& g) {
        Zones& zones = model_.zones;
        const std::size_t columns = law_.model->history.size();
        const Row count = zones_of_cell * at.cells;
        bool blank = g.blank && all_zero_rows(batch_.state + at.first_row, count);
        for (std::size_t k = 0; k < columns && blank; ++k)
            blank = all_zero_rows(batch_.history[k] + at.first_row, count);
        if (blank) return;
        for (Row z = 0; z < zones_of_cell; ++z)
            for (Row l = 0; l < at.cells; ++l)
                zones.state[at.zone + zones_of_cell * l + z] = batch_.state[at.row(z) + l];
        for (std::size_t k = 0; k < columns; ++k) {
            SixEights kept;
            for (Row z = 0; z < zones_of_cell; ++z) kept[z] = load_rows(batch_.history[k] + at.row(z), at.cells);
            store_six(&zones.history[k][at.zone], 6, at.cells, kept);
        }
    }

    /// Writes stresses to the zones, updates their state, and computes their forces.
    [[gnu::always_inline]] void finish(const Place& at) {
        FlowGroup& g = group_at(at);
        write_history(at, g);
        Eight left;
        const SixZones after = flowed(at, g, left);
        store_zones(model_.zones.stress, at.zone, at.cells, after);

        MadeStress now = made(g, after);
        WarpStress of_both = now.warp;
        for (std::size_t k = 9; k < of_both.size(); ++k) {
            now.warp[k] =
                left *
                (g.kept[k] + young_ * g.warp.strain[k]); // no law runs on the strain of fibres: theory, "Six points"
            of_both[k] = g.kept[k] + now.warp[k];
            g.kept[k] = now.warp[k];
        }
        store_warps(model_.zones.warp, at.zone, at.cells, g.kept);
        Eight work = g.work + g.volume * product(now.mean, g.strain) + g.warp.work(g.volume, of_both);
        if (damping_ > 0) damp(at, g, after, now);
        CellForces forces = forces_of(g.shape, now.mean, now.warp);
        if (g.has_initial) {
            const InitialForces start(model_, g.shape, from_first(rows_.places(), g.corners),
                                      from_first(rows_.shifts(), g.corners), g.initial, g.strain, g.volume,
                                      rows_.outer(at.zone));
            work += 2.0 * start.work;
            forces = both(forces, start.forces);
        }
        forces_.add(g.corners, at.cells, forces);
        add_to(work_, of_cells(at, work));
    }

    /// Half of a sum over two moments, without the lanes that hold no cell.
    static Eight of_cells(const Place& at, Eight work) {
        for (Row l = at.cells; l < eight; ++l) work[l] = 0;
        return 0.5 * work;
    }

    /// The stresses after the step. `left`: the squares of the deviators over what they would be without flow.
    [[gnu::always_inline]] SixZones flowed(const Place& at, const FlowGroup& g, Eight& left) const {
        SixZones after;
        MaskOfEight changed{}; // bits that differ from those of an elastic step
        for (Row z = 0; z < zones_of_cell; ++z) {
            after[z] = rows_of(batch_.stress, at, z);
            if (wet_)
                for (std::size_t k = 0; k < 3; ++k) after[z][k] -= load_rows(batch_.pressure + at.row(z), at.cells);
            const SixEights trial = elastic_trial(g.before[z], rows_of(batch_.strain, at, z));
            for (std::size_t k = 0; k < 6; ++k)
                changed |=
                    reinterpret_cast<const MaskOfEight&>(after[z][k]) ^ reinterpret_cast<const MaskOfEight&>(trial[k]);
        }
        left = eights(1);
        if (!all(changed == 0)) flow(at, g, after, left);
        return after;
    }

    template <std::size_t length>
    [[gnu::always_inline]] static SixEights rows_of(const double (&columns)[6][length], const Place& at, Row z) {
        SixEights rows;
        for (std::size_t k = 0; k < 6; ++k) rows[k] = load_rows(columns[k] + at.row(z), at.cells);
        return rows;
    }

    /// The same where zones flow.
    [[gnu::noinline]] void flow(const Place& at, const FlowGroup& g, SixZones& after, Eight& left) const {
        SixZones beyond; // what flow has changed
        for (Row z = 0; z < zones_of_cell; ++z)
            beyond[z] = difference(after[z], elastic_trial(g.before[z], rows_of(batch_.strain, at, z)));
        left = part_left(after, beyond);
        if (averages_) average(after, beyond);
    }

    static Eight part_left(const SixZones& after, const SixZones& beyond) {
        Eight squares{}, elastic{};
        for (Row z = 0; z < zones_of_cell; ++z) {
            squares += square_of_deviator(after[z]);
            elastic += square_of_deviator(difference(after[z], beyond[z]));
        }
        const Eight left = larger_of(squares, Eight{}) / larger_of(elastic, Eight{}); // they may be below 0 by rounding
        return left < 1 - 1e-12 ? left : eights(1); // cells without deviators divide 0 by 0
    }

    /// Averages the plastic changes of the mean stress over the three pairs of layers: equation (14).
    static void average(SixZones& after, const SixZones& beyond) {
        std::array<Eight, 3> flow;
        for (std::size_t a = 0; a < 3; ++a)
            flow[a] = 0.5 * (mean_of_three(beyond[layer_zones[a].upper]) + mean_of_three(beyond[layer_zones[a].lower]));
        const Eight mean = (flow[0] + flow[1] + flow[2]) * (1.0 / 3);
        for (std::size_t a = 0; a < 3; ++a)
            for (const Row z : {layer_zones[a].upper, layer_zones[a].lower})
                for (std::size_t k = 0; k < 3; ++k) after[z][k] += mean - flow[a];
    }

    [[gnu::always_inline]] SixEights elastic_trial(const SixEights& before, const SixEights& strain) const {
        const auto& [lambda, two_shear] = law_.elastic;
        const Eight mean = lambda * (strain[0] + strain[1] + strain[2]);
        SixEights stress;
        for (std::size_t k = 0; k < 6; ++k) stress[k] = before[k] + two_shear * strain[k];
        for (std::size_t k = 0; k < 3; ++k) stress[k] += mean;
        return stress;
    }

    /// Adds the viscous stresses of the step.
    [[gnu::noinline]] void damp(const Place& at, const FlowGroup& g, const SixZones& after, MadeStress& now) {
        Zones& zones = model_.zones;
        const SixZones last = load_zones(zones.dashpot, at.zone, at.cells);
        SixZones viscous;
        for (Row z = 0; z < zones_of_cell; ++z)
            viscous[z] = viscous_stress(difference(after[z], g.before[z]), rows_of(batch_.strain, at, z), law_.elastic,
                                        damping_);
        store_zones(zones.dashpot, at.zone, at.cells, viscous);
        WarpStress fibres;
        load_warps(zones.warp_dashpot, at.zone, at.cells, fibres);
        MadeStress taken = made_stress(g.planes, sum(last, viscous));
        const WarpStress elastic = now.warp;
        now = made(g, sum(after, viscous));
        for (std::size_t k = 9; k < fibres.size(); ++k) {
            const Eight more = damping_ * (young_ * g.warp.strain[k]);
            taken.warp[k] = fibres[k] + more;
            fibres[k] = more;
            now.warp[k] = elastic[k] + more;
        }
        store_warps(zones.warp_dashpot, at.zone, at.cells, fibres);
        add_to(damped_work_,
               of_cells(at, g.volume * product(taken.mean, g.strain) + g.warp.work(g.volume, taken.warp)));
    }

    Model& model_;
    const ZoneTile& tile_;
    const ZoneLaw& law_;
    const double young_, damping_;
    const bool large_, wet_, averages_;
    TileRows rows_;
    TileForces forces_;
    StagedZones<groups_in_batch * zones_of_group> batch_;
    std::array<FlowGroup, groups_in_batch> groups_;
    Lanes work_ = Lanes{}, damped_work_ = Lanes{};
};

} // namespace

ZoneSums run_flowing_cells(Model& model, const ZoneTiles& tiles, const ZoneTile& tile, const ZoneLaw& law,
                           const std::vector<double>& pressure, std::vector<PointRow>& forces) {
    return FlowingCells(model, tiles, tile, law, pressure, forces).run();
}

} // namespace kaya
