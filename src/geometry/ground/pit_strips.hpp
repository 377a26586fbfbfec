// Triangles of the strips of a pit, one strip for each edge of its crest.
#pragma once

#include "base/vector.hpp"
#include "geometry/ground/pit_profile.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace kaya {

using SectionVector = Eigen::Vector2d;

/// The region nearer to one edge of the crest than to the others, by the straight skeleton.
struct PitStrip {
    SectionVector from = SectionVector::Zero(), along = SectionVector::Zero(); ///< the edge; the pit lies to the left
    CrestEdge edge;
    std::vector<SectionVector> corners;
    std::vector<RampPart> ramp;
};

struct PitMesh {
    std::vector<Vec3> corners;
    std::vector<std::array<int, 3>> triangles;
};

/// Triangles that bend only where the wall does. Heights are above the crest.
PitMesh mesh_of(const std::vector<PitStrip>& strips, const PitProfile& profile);

} // namespace kaya
