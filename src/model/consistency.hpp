// Whether the tables of a model fit together.
#pragma once

#include "model/model.hpp"

#include <string>

namespace kaya {

/// Empty when every row link, span, id and number of choice is inside its table; otherwise a sentence
/// about the first that is not: "row 3 of zones: gridpoint 99 of 8". What passes can be used by all other
/// code without a check of its own; restore asks this before it hands over what it read.
std::string inconsistency(Model& model);

} // namespace kaya
