// One zone that belongs to no block, to see whether a zone model keeps to its columns.
#pragma once

#include "laws/zone_model.hpp"

namespace kaya {

/// Runs one step of a batch of one zone, in columns of its own between fences: a failure also names what the model has written to
/// that it may only read, and the column after or before which it has written. The columns of the batch get what it has left.
std::optional<ZoneFailure> run_fenced(const ZoneModel& model, kaya_zbatch& batch);

/// Tries some steps of one zone from rest. Throws Diagnostic (Fault::run) when the model writes where it must not; what else goes
/// wrong with it is for the zones of a run to tell.
void try_zone(const ZoneModel& model, const std::vector<double>& values);

} // namespace kaya
