#include "geometry/polyhedra/plan_hull.hpp"

#include <algorithm>

namespace kaya {

std::vector<Vec3> plan_hull(std::vector<Vec3> points) {
    std::vector<Vec3> hull;
    std::ranges::sort(points,
                      [](const Vec3& a, const Vec3& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
    const auto chain = [&](auto first, auto last) {
        const std::size_t kept = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() >= kept + 2 && plan_cross(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();
    };
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    return hull;
}

} // namespace kaya
