#include "mechanics/common/near_pairs.hpp"

namespace kaya {

namespace {

/// Margin on every side, in parts of the box's longest edge.
constexpr double room = 0.02;

bool inside(const Box& box, const Box& around) {
    return (box.low.array() >= around.low.array()).all() && (box.high.array() <= around.high.array()).all();
}

} // namespace

const std::vector<std::array<int, 2>>& NearPairs::of(const std::vector<Box>& boxes) {
    bool all_inside = boxes.size() == rooms_.size();
    for (std::size_t b = 0; all_inside && b < boxes.size(); ++b) all_inside = inside(boxes[b], rooms_[b]);
    if (all_inside) return pairs_;
    rooms_ = boxes;
    for (auto& box : rooms_) {
        const Vec3 around = Vec3::Constant(room * (box.high - box.low).maxCoeff());
        box.low -= around;
        box.high += around;
    }
    pairs_ = overlapping_boxes(rooms_);
    return pairs_;
}

} // namespace kaya
