// Loads and prescribed velocities that a variable of scripts scales: `hist @name`.
#pragma once

#include "model/tables/model.hpp"

#include <string>
#include <vector>

namespace kaya {

/// Rows of Model::boundary_histories of one kind, all of blocks that are there.
struct ScaledHistories {
    bool are_velocities = false; ///< velocities, not loads
    std::vector<Row> rows;
};

/// The histories of `variable`. Throws Diagnostic when there are none, or when it scales loads and velocities at once.
ScaledHistories scaled_histories(const Model& model, const std::string& variable);

/// Whether a function of time is this variable of FISH. No function has an empty name.
bool is_variable(const TimeFunction& function, const std::string& variable);

} // namespace kaya
