// Which bodies a range of `bound` and `initialize` means.
#pragma once

#include "commands/session/session.hpp"
#include "mechanics/supports/boundary.hpp"

#include <array>
#include <optional>

namespace kaya {

/// Rigid blocks by their centroid and gridpoints of the others by their position. Warns when there are none.
Bodies pick_bodies(Session& session, const lang::RangePhrase& range);

/// Refuses a rotation (the last three of the components) where no body of a range is rigid: gridpoints of zones have none. A line that holds
/// all components at 0 may name it.
void check_rotation(const Model& model, const Bodies& bodies, const std::array<std::optional<double>, 6>& velocity,
                    const Place& place);

} // namespace kaya
