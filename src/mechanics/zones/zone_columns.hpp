// The columns of a batch of zones, between the steps of its work.
#pragma once

#include "mechanics/zones/tetrahedra.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>

namespace kaya {

constexpr std::size_t most_zones_in_batch = 128; ///< zones in a batch
constexpr std::size_t zone_column_length =
    most_zones_in_batch + 8; ///< of a column: with powers of two all columns would share the same lines of the cache

/// Columns of a batch for a zone model, and additional ones for the work after it.
struct ZoneColumns {
    alignas(64) double strain[6][zone_column_length], spin[3][zone_column_length], before[6][zone_column_length],
        stress[6][zone_column_length], edge[9][zone_column_length];
    alignas(64) double volume[zone_column_length], volume_strain[zone_column_length], pressure[zone_column_length],
        dissipation[zone_column_length];
    double* history[KAYA_JMODEL_MAX_HISTORY];
    kaya_zbatch batch;

    ZoneColumns(Model& model, Row first, Row count, const ZoneLaw& law) {
        point_to(batch, law, model, *this);
        batch.n = static_cast<std::size_t>(count);
        batch.state = model.zones.state.data() + first;
        for (std::size_t k = 0; k < law.model->history.size(); ++k) history[k] = model.zones.history[k].data() + first;
        batch.history = history;
        std::fill_n(dissipation, batch.n, 0.0);
    }

    void keep(Row i, const Edges& edges) {
        for (std::size_t a = 0; a < 3; ++a) {
            store(edge[3 * a] + i, edges[a].x);
            store(edge[3 * a + 1] + i, edges[a].y);
            store(edge[3 * a + 2] + i, edges[a].z);
        }
    }
    Edges edges(Row i) const {
        Edges edges;
        for (std::size_t a = 0; a < 3; ++a)
            edges[a] = {at(edge[3 * a] + i), at(edge[3 * a + 1] + i), at(edge[3 * a + 2] + i)};
        return edges;
    }
    static Eight at(const double* rows) { return load_as<Eight>(rows); }
};

} // namespace kaya
