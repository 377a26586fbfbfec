// A modified file that its reader can accept: with other coordinates, spellings of numbers, spaces or line ends.
#pragma once

#include "values.hpp"

#include <string>

namespace kaya::soak {

std::string changed_validly(std::string bytes, Chance& c);

} // namespace kaya::soak
