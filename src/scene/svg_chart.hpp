// Curves as an SVG picture.
#pragma once

#include "scene/scene.hpp"

#include <string>

namespace kaya {

std::string svg_of(const Chart& chart);

} // namespace kaya
