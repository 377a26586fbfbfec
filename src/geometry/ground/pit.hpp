// The walls of a pit below a closed line: faces, berms and a ramp.
#pragma once

#include "geometry/ground/ground.hpp"
#include "geometry/ground/pit_design.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// The surface within the crest: each edge has its own faces and berms, which meet those of its neighbours on the straight skeleton of the
/// crest. The ramp runs along the wall and shifts the surface below it inward by its width; it begins with a part as long as it is wide, in
/// which it reaches its width, and is level around corners. Throws Diagnostic where the outline crosses itself or is not level, the walls
/// meet above the floor, an edge vanishes outward from a toe, or the ramp finds no room.
Ground pit_surface(const std::vector<Vec3>& outline, const PitDesign& design);

/// A design and its outline as text: a word and its numbers to a line, then the points of the outline. docs/commands/cut.md
Ground ground_from_pit(std::string_view text, const std::string& file);

} // namespace kaya
