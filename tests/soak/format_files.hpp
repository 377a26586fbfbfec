// Small valid files of further formats that `import` reads.
#pragma once

#include "scenes.hpp"

#include <vector>

namespace kaya::soak {

std::vector<Sample> format_files();

} // namespace kaya::soak
