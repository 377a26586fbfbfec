// Which bodies a range of `bound` and `initialize` means.
#pragma once

#include "commands/session.hpp"
#include "mechanics/boundary.hpp"

namespace kaya {

/// Rigid blocks by their centroid and gridpoints of the others by their position. Warns when there are none.
Bodies pick_bodies(Session& session, const lang::RangePhrase& range);

} // namespace kaya
