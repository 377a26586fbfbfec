#include "mechanics/zones/cell_motion.hpp"

#include "mechanics/zones/tile_rows.hpp"

#include <algorithm>

namespace kaya {

namespace {

/// Calls each(law, first zone of a cell) for all elastic cells.
template <class Each> void for_cells(const ZoneLaws& laws, Each each) {
    for (const ZoneTile& tile : laws.tiles.tiles)
        if (const ZoneLaw& law = laws.laws[tile.law]; law.together == Together::cells)
            for (Row zone = tile.first; zone < tile.last; zone += zones_of_cell) each(law, zone);
}

} // namespace

void part_cell_motion(Model& model, const ZoneLaws& laws) {
    Zones& zones = model.zones;
    std::size_t columns = 0;
    for_cells(laws, [&](const ZoneLaw& law, Row first) {
        for (Row z = first + 1; z < first + zones_of_cell && columns <= law.cell_history; ++z)
            if (zones.stress[z] != zones.stress[first]) columns = law.cell_history + 3;
    });
    zones.keep_history(columns);
}

void keep_cell_motion(Model& model, const ZoneLaws& laws) {
    Zones& zones = model.zones;
    if (std::ranges::all_of(laws.laws, [&](const ZoneLaw& law) {
            return law.together != Together::cells || keeps_cell_motion(zones, law);
        }))
        return;
    const auto had = static_cast<std::size_t>(zones.history_columns);
    for_cells(laws, [&](const ZoneLaw& law, Row first) {
        if (had > law.cell_history + 2) return;
        zones.keep_history(law.cell_history + 3);
        for (Row k = 0; k < zones_of_cell; ++k) zones.history[law.cell_history + 2][first + k] = zones.stress[first][k];
    });
}

void forget_cell_motion(Model& model, ZoneModels& models, const std::vector<Row>& zones) {
    Row known = no_row;
    std::size_t column = 0;
    for (const Row z : zones) {
        const Row block = model.zones.block[z];
        if (model.blocks.cell_zones[block] != zones_of_cell || model.zones.history_columns <= 4) continue;
        if (block != known) column = first_cell_history(models.get(zone_model_of(model, block))) + 2;
        known = block;
        if (column < static_cast<std::size_t>(model.zones.history_columns)) model.zones.history[column][z] = 0;
    }
}

void scale_zone_stresses(Model& model, const ZoneLaws& laws, double factor) {
    Zones& zones = model.zones;
    for (Stress& stress : zones.stress) stress *= factor;
    for_cells(laws, [&](const ZoneLaw& law, Row first) {
        const auto columns = std::min<std::size_t>(law.cell_history + 3, zones.history_columns);
        for (std::size_t k = law.cell_history; k < columns; ++k)
            for (Row z = first; z < first + zones_of_cell; ++z) zones.history[k][z] *= factor;
    });
}

} // namespace kaya
