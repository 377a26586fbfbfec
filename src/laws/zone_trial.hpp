// One zone without a block, to test whether a zone model writes only to its columns.
#pragma once

#include "laws/zone_model.hpp"

namespace kaya {

/// Runs one step of a batch of one zone, in separate columns between fences: a failure also names read-only data that the model changed,
/// and the column after or before which it wrote. The results are copied to the columns of the batch.
std::optional<ZoneFailure> run_fenced(const ZoneModel& model, kaya_zbatch& batch);

/// Tries some steps of one zone from rest. Throws Diagnostic (Fault::run) when the model writes outside of its columns; other failures are
/// reported by the run.
void try_zone(const ZoneModel& model, const std::vector<double>& values);

} // namespace kaya
