#include "mechanics/zones/cell_state.hpp"

#include "mechanics/zones/cell_forces.hpp"

#include <algorithm>

namespace kaya {

namespace {

/// Calls each(law, first zone of a cell) for all cells.
template <class Each> void for_cells(const ZoneLaws& laws, Each each) {
    for (const ZoneTile& tile : laws.tiles.tiles)
        if (const ZoneLaw& law = laws.laws[tile.law]; by_cells(law.together))
            for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell) each(law, zone);
}

bool have_one_stress(const Zones& zones, Row first) {
    return std::all_of(&zones.stress[first] + 1, &zones.stress[first] + zones_of_cell,
                       [&](const Stress& s) { return s == zones.stress[first]; });
}

void set_initial_stress(Zones& zones, Row first) {
    const bool differ = !have_one_stress(zones, first);
    if (!differ && !zones.keeps_initial) return;
    zones.keep_initial();
    for (Row z = first; z < first + zones_of_cell; ++z)
        zones.initial[z] = differ ? zones.stress[z] : Stress(Stress::Zero());
}

/// Halves of the mean edges of one cell, in all lanes.
std::array<Eight3, 3> axes_of(const Model& model, Row first) {
    const auto corners = corners_of_cell(&model.zones.gridpoints[first]);
    CellField place;
    for (std::size_t c = 1; c < 8; ++c) {
        const Vec3 x = model.gridpoints.position[corners[c]] - model.gridpoints.position[corners[0]];
        place[c - 1] = {eights(x.x()), eights(x.y()), eights(x.z())};
    }
    std::array<Eight3, 3> axes = CornerSums(place).axis;
    for (Eight3& axis : axes) axis = axis * eights(0.125);
    return axes;
}

/// A column of stresses by zone, and that of the warps that belongs to it.
struct LayerColumns {
    Column<Stress>& zones;
    WarpColumns& warps;
};

/// From the warps into the zones.
void put_layers(const LayerColumns& columns, const std::array<Eight3, 3>& axes, Row first) {
    WarpStress warp;
    load_warps(columns.warps, first, 1, warp);
    SixZones stress = load_zones(columns.zones, first, 1);
    for (std::size_t a = 0; a < 3; ++a) {
        const Eight3 &b = axes[(a + 1) % 3], &c = axes[(a + 2) % 3];
        const Eight *const own = &warp[3 * a], &bb = own[0], &cc = own[1], &bc = own[2];
        const SixEights layer = sum(tensor(b, b * bb + c * bc), tensor(c, b * bc + c * cc));
        const auto [upper, lower] = layer_zones[a];
        stress[upper] = sum(stress[upper], layer);
        stress[lower] = difference(stress[lower], layer);
    }
    std::fill_n(warp.begin(), 9, Eight{});
    store_warps(columns.warps, first, 1, warp);
    store_zones(columns.zones, first, 1, stress);
}

/// From the zones, beyond `initial` if given, into the warps, apart from fibres: all zones then have the mean.
void take_layers(const LayerColumns& columns, const Column<Stress>* initial, const std::array<Eight3, 3>& axes,
                 const ZoneLaw& law, Row first) {
    WarpStress warp;
    load_warps(columns.warps, first, 1, warp);
    SixZones stress = load_zones(columns.zones, first, 1), start{};
    if (initial) start = load_zones(*initial, first, 1);
    stress = difference(stress, start);
    const MadeStress made = made_stress(planes_of(axes, law.elastic), stress);
    std::copy_n(made.warp.begin(), 9, warp.begin());
    for (SixEights& zone : start) zone = sum(zone, made.mean);
    store_warps(columns.warps, first, 1, warp);
    store_zones(columns.zones, first, 1, start);
}

} // namespace

void note_initial_stress(Model& model, const std::vector<Row>& zones) {
    Row last = no_row; // zones of a cell follow each other
    for (const Row z : zones) {
        const Row block = model.zones.block[z];
        if (model.blocks.cell_zones[block] != zones_of_cell) continue;
        const Row start = model.blocks.zones[block].first, first = z - (z - start) % zones_of_cell;
        if (first != last) set_initial_stress(model.zones, first);
        last = first;
    }
}

void settle_cells(Model& model, const ZoneLaws& laws) {
    Zones& zones = model.zones;
    for_cells(laws, [&](const ZoneLaw& law, Row first) {
        const bool layered = zones.keeps_layers && zones.layered[first] != 0,
                   flows = law.together == Together::flow_in_cells;
        // Models saved by earlier versions have no initial stress.
        if (!layered && !has_initial(zones, first, 1)) set_initial_stress(zones, first);
        if (layered == flows) return;
        zones.keep_layers();
        std::fill_n(&zones.layered[first], zones_of_cell, static_cast<std::uint8_t>(flows));
        const std::array<Eight3, 3> axes = axes_of(model, first);
        const auto settle = [&](const LayerColumns& columns, const Column<Stress>* initial) {
            if (flows) put_layers(columns, axes, first);
            else take_layers(columns, initial, axes, law, first);
        };
        settle({zones.stress, zones.warp}, zones.keeps_initial ? &zones.initial : nullptr);
        if (zones.keeps_dashpots && zones.keeps_warp_dashpots) settle({zones.dashpot, zones.warp_dashpot}, nullptr);
    });
}

void scale_zone_stresses(Model& model, double factor) {
    Zones& zones = model.zones;
    for (auto* column : {&zones.stress, &zones.initial})
        for (Stress& stress : *column) stress *= factor;
    for (auto& column : zones.warp)
        for (double& stress : column) stress *= factor;
}

void share_masses(Model& model, const ZoneLaws& laws) {
    const Zones& zones = model.zones;
    Gridpoints& g = model.gridpoints;
    const std::vector<double> before(g.mass.begin(), g.mass.end());
    for_cells(laws, [&](const ZoneLaw&, Row first) {
        const Row block = zones.block[first];
        const double density = model.blocks.mass[block] / model.blocks.volume[block];
        double whole = 0;
        for (Row z = first; z < first + zones_of_cell; ++z) {
            const double mass = density * zones.volume[z];
            whole += mass;
            for (const Row corner : zones.gridpoints[z]) g.mass[corner] -= 0.25 * mass;
        }
        for (const Row corner : corners_of_cell(&zones.gridpoints[first])) g.mass[corner] += 0.125 * whole;
    });
    for (std::size_t row = 0; row < before.size(); ++row)
        if (before[row] != g.mass[row]) g.inertial_mass[row] *= g.mass[row] / before[row];
}

} // namespace kaya
