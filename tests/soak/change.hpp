// A modified file: with changed numbers, words, lines or bytes, or truncated.
#pragma once

#include "values.hpp"

#include <string>

namespace kaya::soak {

std::string changed(std::string bytes, Chance& c);

} // namespace kaya::soak
