// A warning of new blocks in the place of others.
#pragma once

#include "base/diagnostic.hpp"
#include "model/tables/model.hpp"

namespace kaya {

class Session;

/// Warns once per model when one of the blocks from `first` on occupies the place of another.
void warn_of_overlaps(Session& session, Row first, const Place& place);

} // namespace kaya
