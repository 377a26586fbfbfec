// A file that somebody has changed: numbers, words, lines and bytes of it, or its end is missing.
#pragma once

#include "values.hpp"

#include <string>

namespace kaya::soak {

std::string changed(std::string bytes, Chance& c);

} // namespace kaya::soak
