#include "mechanics/zones/cell_stresses.hpp"

#include "base/parallel.hpp"
#include "mechanics/zones/cells.hpp"

#include <algorithm>

namespace kaya {

void CellStresses::make_room(const ZoneTiles& tiles) {
    if (stress_.size() == static_cast<std::size_t>(tiles.groups())) return;
    stress_.resize(static_cast<std::size_t>(tiles.groups()));
    here_.assign(stress_.size(), 0);
}

void CellStresses::give_back(Model& model, const ZoneTiles& tiles) {
    if (std::ranges::none_of(here_, [](char here) { return here != 0; })) return;
    for_chunks(tiles.tiles.size(), 1, [&](std::size_t t, std::size_t) {
        const ZoneTile& tile = tiles.tiles[t];
        if (!tile.has_cells) return;
        for (Row zone = tile.first; zone < tile.last; zone += zones_of_group)
            if (const Row group = tile.group(zone); has(group))
                store_six(model.zones.stress[zone].data(), to_next_cell, cells_from(zone, tile.last), of(group),
                          zones_of_cell);
    });
    std::ranges::fill(here_, 0);
}

} // namespace kaya
