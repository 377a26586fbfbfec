#include "geometry/polyhedra/box_pairs.hpp"

#include "base/stop_point.hpp"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <algorithm>

namespace kaya {

Box box_around(const std::vector<Vec3>& points) {
    Box box{points.front(), points.front()};
    for (const Vec3& point : points) {
        box.low = box.low.cwiseMin(point);
        box.high = box.high.cwiseMax(point);
    }
    return box;
}

std::vector<std::array<int, 2>> overlapping_boxes(const std::vector<Box>& boxes) {
    using Numbered = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
    std::vector<Numbered> numbered;
    numbered.reserve(boxes.size());
    for (const auto& box : boxes) {
        numbered.emplace_back(
            CGAL::Bbox_3(box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z()),
            static_cast<int>(numbered.size()));
    }
    std::vector<std::array<int, 2>> pairs;
    StopPoints stops;
    CGAL::box_self_intersection_d(numbered.begin(), numbered.end(), [&](const Numbered& a, const Numbered& b) {
        stops.pass();
        pairs.push_back({std::max(a.info(), b.info()), std::min(a.info(), b.info())});
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace kaya
