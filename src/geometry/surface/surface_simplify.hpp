// Surfaces with fewer triangles: scans have more than blocks can use.
#pragma once

#include "geometry/surface/surface.hpp"

#include <algorithm>
#include <cstdint>

namespace kaya {

/// How far surfaces are simplified; with both limits until the first is reached.
struct Simplification {
    std::int64_t faces = 0; ///< greatest number of triangles of a body, 0: not limited by number
    double deviation =
        0; ///< greatest distance between the old and the new surface, a length, 0: not limited by distance
    bool wanted() const { return faces > 0 || deviation > 0; }
};

/// Sums over the surfaces that were simplified.
/// Of bodies that became simpler: triangles of surfaces, or convex parts.
struct SimplifyCounts {
    std::size_t bodies = 0, before = 0, after = 0;
    double deviation = 0; ///< of surfaces, the greatest, a length
    double volume_before = 0, volume_after = 0;

    void add(const SimplifyCounts& other) {
        bodies += other.bodies;
        before += other.before;
        after += other.after;
        deviation = std::max(deviation, other.deviation);
        volume_before += other.volume_before;
        volume_after += other.volume_after;
    }
};

/// Collapses edges of a closed surface, those first that change volume and shape least (Lindstrom and Turk 1998). The result is closed and does
/// not cross itself; where a collapse would make it cross, the edges nearby are kept, and the result may have more triangles than wanted. The
/// deviation is measured from all corners of the old surface and from fifteen points of each new triangle. Throws Diagnostic where the given
/// surface is open or crosses itself.
Surface simplified(Surface surface, const Simplification& wanted, SimplifyCounts& counts);

} // namespace kaya
