// Drawings as PNG files in memory.
#pragma once

#include "scene/scene.hpp"

#include <string>

namespace kaya {

std::string png_of(const Scene& scene);
std::string png_of(const Chart& chart);
std::string png_of(const ScenePair& pair);

} // namespace kaya
