// Networks of fractures that grow until they are dense enough.
#pragma once

#include "geometry/fractures/fracture_law.hpp"

#include <functional>
#include <vector>

namespace kaya {

/// Where fractures are drawn, and how many.
struct Growth {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero(); ///< the box of their centres
    enum class Until { count, area, crossings, percolation } until = Until::count;
    /// Number; area per volume of the box; crossings per length of the line; pi^2 r^3 of whole discs per volume of the box.
    double target = 1;
    Vec3 begin = Vec3::Zero(), end = Vec3::Zero(); ///< of the line
};

/// The fractures that were drawn until the target was met; the last one is left out if the network is nearer to the target without it.
/// `progress` gets the part that is done. Throws Diagnostic when a million are not enough.
std::vector<Disc> grow(const FractureLaw& law, const Growth& growth, Random random,
                       const std::function<void(double)>& progress = {});

} // namespace kaya
