#include "mechanics/zones/cell_motion.hpp"

#include "mechanics/zones/tile_rows.hpp"

#include <algorithm>
#include <utility>

namespace kaya {

namespace {

/// Calls each(law, first zone of a cell) for all cells whose zones strain together.
template <class Each> void for_cells(const ZoneLaws& laws, Each each) {
    for (const ZoneTile& tile : laws.tiles.tiles)
        if (const ZoneLaw& law = laws.laws[tile.law]; law.together == Together::cells)
            for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell) each(law, zone);
}

} // namespace

void part_cell_motion(Model& model, const ZoneLaws& laws) {
    Zones& zones = model.zones;
    if (zones.keeps_cell_motion) return;
    bool differ = false;
    for_cells(laws, [&](const ZoneLaw&, Row first) {
        for (Row z = first + 1; z < first + zones_of_cell && !differ; ++z)
            differ = zones.stress[z] != zones.stress[first];
    });
    if (!differ) return;
    zones.keep_cell_motion();
    // Cells whose zones have one stress: all of it acts on ruled faces.
    for_cells(laws, [&](const ZoneLaw&, Row first) {
        for (Row z = first + 1; z < first + zones_of_cell; ++z)
            if (zones.stress[z] != zones.stress[first]) return;
        for (Row k = 0; k < zones_of_cell; ++k) zones.cell_motion[first + k] = zones.stress[first][k];
    });
}

void forget_cell_motion(Model& model, const std::vector<Row>& zones) {
    if (!model.zones.keeps_cell_motion) return;
    for (const Row z : zones) model.zones.cell_motion[z] = 0;
}

void scale_zone_stresses(Model& model, double factor) {
    Zones& zones = model.zones;
    for (Stress& stress : zones.stress) stress *= factor;
    for (auto* column : {&zones.warp[0], &zones.warp[1], &zones.cell_motion})
        for (double& stress : *column) stress *= factor;
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

void take_cells_from_history(Model& model, const ZoneLaws& laws) {
    Zones& zones = model.zones;
    constexpr std::size_t least = 2; // columns before them
    for_cells(laws, [&](const ZoneLaw& law, Row first) {
        const std::size_t column = std::max(law.model->history.size(), least);
        const auto move = [&](std::size_t from, Column<double>& to) {
            if (from >= static_cast<std::size_t>(zones.history_columns)) return;
            for (Row z = first; z < first + zones_of_cell; ++z) to[z] = std::exchange(zones.history[from][z], 0.0);
        };
        for (std::size_t half = 0; half < 2; ++half) move(column + half, zones.warp[half]);
        if (static_cast<std::size_t>(zones.history_columns) > column + 2) {
            zones.keep_cell_motion();
            move(column + 2, zones.cell_motion);
        }
    });
}

} // namespace kaya
