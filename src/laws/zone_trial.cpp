#include "laws/zone_trial.hpp"

#include "base/diagnostic.hpp"
#include "laws/guard.hpp"
#include "laws/trespass.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

/// A zone at rest, without stress, that turns a little in each step.
struct LoneZone {
    std::array<double, 3> spin{1e-3, -2e-3, 5e-4};
    std::array<double, 6> strain{}, stress{};
    std::array<double, KAYA_JMODEL_MAX_HISTORY> history{};
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> columns{};
    double volume = 1, pressure = 0, dissipation = 0;
    std::uint32_t state = 0;

    kaya_zbatch batch(const std::vector<double>& values) {
        for (std::size_t k = 0; k < history.size(); ++k) columns[k] = &history[k];
        kaya_zbatch b{};
        b.n = 1;
        b.properties = values.data();
        b.time_step = 1;
        b.volume = &volume;
        b.pore_pressure = &pressure;
        b.dissipation = &dissipation;
        b.state = &state;
        b.history = columns.data();
        for (int k = 0; k < 6; ++k) {
            b.strain_inc[k] = &strain[k];
            b.stress[k] = &stress[k];
        }
        for (int k = 0; k < 3; ++k) b.spin[k] = &spin[k];
        return b;
    }
};

} // namespace

std::optional<ZoneFailure> run_fenced(const ZoneModel& model, kaya_zbatch& batch, std::int32_t first,
                                      const std::int32_t* numbers) {
    static thread_local FencedBatch<kaya_zbatch> fences; // threads call laws at the same time
    fences.take(model, batch);
    auto failure = model.run(batch, first, numbers);
    const auto trespass = fences.trespass();
    fences.give(batch);
    if (trespass) return ZoneFailure{trespass->row, fmt::format("zone model {} {}", model.name, trespass->what), true};
    return failure;
}

std::optional<ZoneFailure> run_guarded(const ZoneModel& model, kaya_zbatch& batch, std::int64_t cycle,
                                       std::int32_t first, const std::int32_t* numbers) {
    constexpr std::int32_t zones_in_batch = 128;
    if (guard_in_cycle(model, cycle, first / zones_in_batch) == Guard::fenced)
        return run_fenced(model, batch, first, numbers);
    return model.run(batch, first, numbers);
}

void try_zone(const ZoneModel& model, const std::vector<double>& values) {
    // From strains at which no rock yields to those at which all does, compression first: there the stress is farthest from yielding.
    constexpr double strains[] = {1e-6, 1e-4, 1e-2};
    constexpr std::array<std::array<double, 6>, 4> directions{
        {{-1, -1, -1, 0, 0, 0}, {0, 0, -1, 0, 0, 0}, {0.3, -0.2, 0.1, 1, -0.5, 0.2}, {1, 1, 1, 0, 0, 0}}};
    const std::vector<double> own = values; // the trial's, which may be damaged
    for (const auto& direction : directions) {
        LoneZone zone;
        auto batch = zone.batch(own);
        for (const double size : strains) {
            for (std::size_t k = 0; k < 6; ++k) zone.strain[k] = size * direction[k];
            zone.dissipation = 0;
            const auto failure = run_fenced(model, batch);
            if (!failure) continue;
            if (!failure->trespass) break;
            Diagnostic error(
                failure->message,
                fmt::format("it was tried on one zone before the run; correct its source: {}", model.file.string()),
                Fault::run);
            error.code = "zone-model-trespass";
            throw error;
        }
    }
}

} // namespace kaya
