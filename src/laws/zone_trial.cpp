#include "laws/zone_trial.hpp"

#include "base/diagnostic.hpp"
#include "laws/trespass.hpp"

#include <fmt/format.h>

namespace kaya {

namespace {

/// The columns of one zone, each between two fences. Reused to save allocations.
class FencedZone {
public:
    /// Points the batch at the fenced columns, which receive copies of its columns.
    void take(const ZoneModel& model, kaya_zbatch& batch) {
        fences_.clear();
        own_ = batch;
        read_count_ = 0;
        read("volume", batch.volume);
        for (auto*& column : batch.strain_inc) read("strain_inc", column);
        read("pore_pressure", batch.pore_pressure);
        for (auto*& column : batch.stress) fences_.add("stress", column);
        fences_.add("dissipation", batch.dissipation);
        fences_.add("state", batch.state);
        for (std::size_t k = 0; k < model.history.size(); ++k) {
            history_[k] = batch.history[k];
            fences_.add(model.history[k].name.c_str(), history_[k]);
        }
        batch.history = history_.data();
    }

    /// Copies the fenced columns to the columns of the batch, and points the batch at its columns again.
    void give(const ZoneModel& model, kaya_zbatch& batch) {
        for (int k = 0; k < 6; ++k) *own_.stress[k] = *batch.stress[k];
        *own_.dissipation = *batch.dissipation;
        *own_.state = *batch.state;
        for (std::size_t k = 0; k < model.history.size(); ++k) *own_.history[k] = *history_[k];
        own_.row = batch.row;
        std::memcpy(own_.message, batch.message, sizeof own_.message);
        batch = own_;
    }

    /// The forbidden write of the model; nullopt when there is none.
    std::optional<std::string> trespass() {
        for (std::size_t k = 0; k < read_count_; ++k)
            if (sum_of_bits(read_[k].column, 1) != read_[k].sum)
                return fmt::format("wrote to '{}', which it may only read", read_[k].name);
        if (const auto breach = fences_.breach())
            return fmt::format("wrote {}, outside of its data: it takes more rows or more history variables than "
                               "there are",
                               *breach);
        return std::nullopt;
    }

private:
    struct Read {
        const char* name;
        const double* column;
        std::uint64_t sum;
    };
    void read(const char* name, const double*& column) {
        fences_.add(name, column);
        read_[read_count_++] = {name, column, sum_of_bits(column, 1)};
    }

    static constexpr std::size_t most_read = 8;
    Fences<16 + KAYA_JMODEL_MAX_HISTORY> fences_;
    std::array<double*, KAYA_JMODEL_MAX_HISTORY> history_{};
    std::array<Read, most_read> read_{};
    std::size_t read_count_ = 0;
    kaya_zbatch own_{};
};

/// A zone at rest, without stress.
struct LoneZone {
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
        return b;
    }
};

} // namespace

std::optional<ZoneFailure> run_fenced(const ZoneModel& model, kaya_zbatch& batch) {
    static thread_local FencedZone zone; // threads call laws at the same time, each between its own fences
    zone.take(model, batch);
    auto failure = model.run(batch);
    const auto trespass = zone.trespass();
    zone.give(model, batch);
    if (trespass) return ZoneFailure{0, fmt::format("zone model {} {}", model.name, *trespass), true};
    return failure;
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
