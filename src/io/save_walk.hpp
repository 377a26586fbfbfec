// The part of a save file that is not the model, walked by save and restore alike.
#pragma once

#include "io/save.hpp"
#include "model/whole/archive.hpp"

namespace kaya {

void visit_extras(Archive& archive, SaveExtras& extras);

} // namespace kaya
