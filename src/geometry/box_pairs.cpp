#include "geometry/box_pairs.hpp"

#include <CGAL/Box_intersection_d/Box_d.h>
#include <CGAL/box_intersection_d.h>
#include <algorithm>

namespace kaya {

std::vector<std::array<int, 2>> overlapping_boxes(const std::vector<Box>& boxes) {
    using Numbered = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_EXPLICIT>;
    std::vector<Numbered> numbered;
    numbered.reserve(boxes.size());
    for (const auto& box : boxes) {
        // The library counts boxes by the order of their making.
        numbered.emplace_back(box.low.data(), box.high.data());
    }
    const std::size_t first = numbered.empty() ? 0 : numbered.front().id();
    std::vector<std::array<int, 2>> pairs;
    CGAL::box_self_intersection_d(numbered.begin(), numbered.end(), [&](const Numbered& a, const Numbered& b) {
        const int i = static_cast<int>(a.id() - first), j = static_cast<int>(b.id() - first);
        pairs.push_back({std::max(i, j), std::min(i, j)});
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace kaya
