#include "geometry/surface/space_partition.hpp"

#include "base/stop_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace kaya {
namespace {

/// Range of distances of the corners from the plane.
std::pair<double, double> reach(const Fragment& fragment, const Plane& plane) {
    double low = 0, high = 0;
    for (const Vec3& corner : fragment.corners) {
        const double distance = plane.distance(corner);
        low = std::min(low, distance);
        high = std::max(high, distance);
    }
    return {low, high};
}

} // namespace

std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Plane& plane, double sign) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * plane.distance(a), db = sign * plane.distance(b);
        if (da >= 0) part.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(a + da / (da - db) * (b - a));
    }
    return part;
}

Sides sort_sides(const std::vector<Fragment>& fragments, const Plane& plane, double near) {
    Sides sides;
    for (const Fragment& fragment : fragments) {
        const auto [low, high] = reach(fragment, plane);
        if (low >= -near && high <= near) continue; // in the plane: represented by the node itself
        if (low >= -near) {
            sides.front.push_back(fragment);
        } else if (high <= near) {
            sides.back.push_back(fragment);
        } else {
            sides.front.push_back({clip(fragment.corners, plane, 1), fragment.plane, fragment.face});
            sides.back.push_back({clip(fragment.corners, plane, -1), fragment.plane, fragment.face});
        }
    }
    return sides;
}

std::vector<Plane> best_planes(const std::vector<Fragment>& fragments, double near) {
    constexpr std::size_t most_tried = 200, most_kept = 8;
    const std::size_t step = 1 + fragments.size() / most_tried;
    std::vector<Plane> best;
    int fewest = static_cast<int>(fragments.size()) + 1;
    for (std::size_t i = 0; i < fragments.size(); i += step) {
        stop_point();
        const Plane& plane = fragments[i].plane;
        int split = 0;
        constexpr auto none = std::numeric_limits<std::size_t>::max();
        std::size_t counted = none; // a face counts once, however it is divided
        for (const Fragment& other : fragments) {
            const auto [low, high] = reach(other, plane);
            if (!(low < -near && high > near) || other.face == counted) continue;
            ++split;
            counted = other.face;
        }
        if (split < fewest) best.clear();
        fewest = std::min(fewest, split);
        const auto same = [&](const Plane& other) {
            return other.normal.cross(plane.normal).norm() < 1e-9 && std::abs(other.distance(plane.origin)) <= near;
        };
        if (split == fewest && best.size() < most_kept && std::ranges::none_of(best, same)) best.push_back(plane);
    }
    return best;
}

} // namespace kaya
