// The walls of a pit below a closed line: faces, berms and a ramp.
#pragma once

#include "geometry/ground.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

struct PitRamp {
    double width = 0;    ///< length
    double gradient = 0; ///< its descent over its length
    std::array<double, 2> from{};
    bool clockwise = false; ///< seen from above
};

struct PitDesign {
    bool toe = false; ///< the outline is the toe of the lowest face, and not the crest of the uppermost
    double bench = 0; ///< height
    int benches = 1;
    double angle = 0; ///< of the faces, degrees below the horizontal
    double berm = 0;  ///< between the toe of a face and the crest of the next
    std::optional<PitRamp> ramp;
};

/// The surface within the crest: each edge has its own faces and berms, which meet those of its neighbours on the straight skeleton of the
/// crest. The ramp runs along the wall and shifts the surface below it inward by its width; it begins with a part as long as it is wide, in
/// which it reaches its width, and is level around corners. Throws Diagnostic where the outline crosses itself or is not level, the walls
/// meet above the floor, an edge vanishes outward from a toe, or the ramp finds no room.
Ground pit_surface(const std::vector<Vec3>& outline, const PitDesign& design);

/// A design and its outline as text: a word and its numbers to a line, then the points of the outline. docs/commands/cut.md
Ground ground_from_pit(std::string_view text, const std::string& file);

} // namespace kaya
