// The one walk over everything that a Model holds. Hash, save and restore are archives that follow it, so that none can omit what another
// includes.
#pragma once

#include "model/whole/archive.hpp"
#include "model/tables/model.hpp"

namespace kaya {

// A name may be added anywhere: the hash leaves out values of a new model (state_hash.hpp), and a save without the name is restored with
// such a value.
void visit_state(Archive& archive, Model& model);

} // namespace kaya
