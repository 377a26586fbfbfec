// Scenes and charts as bytes, sent from kaya to the program that draws them.
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <variant>

namespace kaya {

using Drawing = std::variant<Scene, Chart, ScenePair>;

std::string to_bytes(Drawing drawing);
/// None when the bytes were not made by to_bytes.
std::optional<Drawing> drawing_from(const std::string& bytes);

} // namespace kaya
