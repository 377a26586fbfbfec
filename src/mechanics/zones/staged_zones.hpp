// Batches of cells for a zone model: copied rows, since the model's own rows have another order.
#pragma once

#include "laws/zone_trial.hpp"
#include "mechanics/zones/zone_laws.hpp"

#include <algorithm>

namespace kaya {

/// A batch of up to so many rows.
template <Row most> struct StagedZones {
    static constexpr std::size_t length = most + 8; ///< powers of two would map all columns to the same cache lines

    alignas(64) double strain[6][length], spin[3][length], stress[6][length], volume[length], pressure[length] = {},
                                                                                              dissipation[length];
    double history[KAYA_JMODEL_MAX_HISTORY][length];
    double* histories[KAYA_JMODEL_MAX_HISTORY];
    std::uint32_t state[length] = {};
    std::int32_t number[length]; ///< of the zone, or the first of the cell, that users see

    StagedZones(const Model& model, const ZoneLaw& law) : law_(law) {
        point_to(batch_, law, model, *this);
        batch_.state = state;
        for (std::size_t k = 0; k < KAYA_JMODEL_MAX_HISTORY; ++k) histories[k] = history[k];
        batch_.history = histories;
    }

    void begin(Row rows) {
        batch_.n = static_cast<std::size_t>(rows);
        std::fill_n(dissipation, batch_.n, 0.0);
    }
    /// Throws Diagnostic when the model fails.
    void run(const Model& model) {
        if (const auto failure = run_guarded(*law_.model, batch_, model.clock.cycle, number[0], number))
            throw failed_zone(model, law_, number[failure->row] - 1, *failure);
    }

    void read_history(Row row, const Zones& zones, Row zone) {
        state[row] = zones.state[zone];
        for (std::size_t k = 0; k < law_.model->history.size(); ++k) history[k][row] = zones.history[k][zone];
    }
    void write_history(Row row, Zones& zones, Row zone) const {
        zones.state[zone] = state[row];
        for (std::size_t k = 0; k < law_.model->history.size(); ++k) zones.history[k][zone] = history[k][row];
    }

private:
    const ZoneLaw& law_;
    kaya_zbatch batch_;
};

} // namespace kaya
