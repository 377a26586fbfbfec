// Velocities and loads that change with time: docs/theory/loads.md.
// reads: boundary_histories, time_functions, clock.time, blocks.force, blocks.moment, gridpoints.force
// writes: blocks.velocity, blocks.rotational_velocity, blocks.angular_momentum, blocks.load, blocks.torque, blocks.load_arms, gridpoints.velocity, gridpoints.load
#pragma once

#include "mechanics/common/hooks.hpp"
#include "mechanics/common/phase_sums.hpp"
#include "model/tables/model.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

/// Histories of boundary conditions grouped by their target, and scratch memory for the values of their functions; derived data.
struct HistoryLists {
    std::vector<Row> velocities, loads; ///< rows of Model::boundary_histories
    std::vector<std::int32_t> velocity_functions, load_functions;
    std::vector<double> factors; ///< of each time function
};

HistoryLists list_boundary_histories(const Model& model);

/// Sets prescribed time-dependent velocities to their values at the middle of the step. Throws Diagnostic (Fault::run) when a function
/// returns a value that is not finite.
HistorySums apply_velocity_histories(Model& model, HistoryLists& lists, const Hooks& hooks);

/// Sets time-dependent loads to their values at the time of the clock. Throws as apply_velocity_histories does.
void apply_load_histories(Model& model, HistoryLists& lists, const Hooks& hooks);

} // namespace kaya
