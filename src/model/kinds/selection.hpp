// The rows that a range phrase picks.
#pragma once

#include "model/kinds/kinds.hpp"
#include "model/tables/model.hpp"

#include <functional>
#include <vector>

namespace kaya {

/// One test of a range, made by src/commands from the phrase in the deck. Ands and ors are folded in.
using RangeTest = std::function<bool(const Model&, ObjectKind, Row)>;

/// Rows of that kind on visible blocks (of contacts both blocks must be visible) that pass.
/// An empty test passes all. Ascending rows.
std::vector<Row> select(const Model& model, ObjectKind kind, const RangeTest& test, bool hidden_too = false);

/// Diagonal of the box around all gridpoints, at least 1e-30; tolerances are fractions of it.
double model_size(const Model& model);

} // namespace kaya
