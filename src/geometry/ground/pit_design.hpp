// The measures of a pit: faces, berms and a ramp.
#pragma once

#include <array>
#include <optional>

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

} // namespace kaya
