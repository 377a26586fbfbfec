// Whether the tables of a model fit together.
#pragma once

#include "model/tables/model.hpp"

#include <string>

namespace kaya {

/// Empty when every row link, span, id and enumeration value is within its table; otherwise a sentence about the first that is not: "row 3
/// of zones: gridpoint 99 of 8". A consistent model can be used without further checks; restore calls this before it returns what it read.
std::string inconsistency(Model& model);

} // namespace kaya
