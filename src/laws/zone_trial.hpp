// One zone without a block, to test whether a zone model writes only to its columns.
#pragma once

#include "laws/zone_model.hpp"

#include <cstdint>
#include <optional>

namespace kaya {

/// Runs one step of a batch, in copies of its columns between fences: a failure also names the read-only data that the model changed, or
/// the column after or before which it wrote. The results are copied to the columns of the batch. `first` and `numbers` as in ZoneModel::run.
std::optional<ZoneFailure> run_fenced(const ZoneModel& model, kaya_zbatch& batch, std::int32_t first = 0,
                                      const std::int32_t* numbers = nullptr);

/// The same in a cycle: fenced at intervals (guard_in_cycle).
std::optional<ZoneFailure> run_guarded(const ZoneModel& model, kaya_zbatch& batch, std::int64_t cycle,
                                       std::int32_t first, const std::int32_t* numbers = nullptr);

/// Tries some steps of one zone from rest. Throws Diagnostic (Fault::run) when the model writes outside of its columns; other failures are
/// reported by the run.
void try_zone(const ZoneModel& model, const std::vector<double>& values);

} // namespace kaya
