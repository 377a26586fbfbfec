// Density of blocks by range. Blocks have the density of their material.
#pragma once

#include "commands/session/session.hpp"

#include <vector>

namespace kaya {

/// Gives the blocks this density. A material that no other block has keeps its number when `all` is set; else the blocks get one that differs
/// from theirs in its density only, a new one if there is none.
void give_density(Session& session, const std::vector<Row>& blocks, double density, bool all);

} // namespace kaya
