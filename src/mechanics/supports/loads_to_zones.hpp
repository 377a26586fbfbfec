// Loads with places on rigid blocks that have been given zones: docs/theory/loads.md.
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <vector>

namespace kaya {

/// Puts the loads that these blocks had as rigid ones on their gridpoints, with the same force and moment: tractions over the faces of the rigid
/// block. Returns the numbers of blocks that had a load without a place too, a moment or a force of a script, which is lost.
std::vector<std::int32_t> put_loads_on_zones(Model& model, const std::vector<Row>& blocks);

} // namespace kaya
