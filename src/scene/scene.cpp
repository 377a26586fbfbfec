#include "scene/scene.hpp"

#include <algorithm>

namespace kaya {

ScenePair side_by_side(Scene left, Scene right) {
    left.width = right.width, left.height = right.height;
    for (ColourBar& one : left.bars)
        for (ColourBar& other : right.bars)
            if (one.title == other.title && one.names.empty() && other.names.empty()) {
                one.low = other.low = std::min(one.low, other.low);
                one.high = other.high = std::max(one.high, other.high);
                one.diverging = other.diverging = one.diverging || other.diverging;
            }
    ScenePair pair{{}, {}, 2 * right.width, right.height, right.paper};
    pair.left = std::move(left), pair.right = std::move(right);
    return pair;
}

} // namespace kaya
