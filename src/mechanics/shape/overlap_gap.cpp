#include "mechanics/shape/overlap_gap.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace kaya {

Between nearest_corners(const Model& model, Row block1, Row block2, const Vec3& n) {
    const auto& x = model.gridpoints.position;
    const Vec3 origin = model.blocks.centroid[block1]; // numbers stay small
    const auto farthest = [&](Row block, const Vec3& direction) {
        const Span span = model.blocks.gridpoints[block];
        double most = -std::numeric_limits<double>::infinity();
        Row best = span.first;
        for (Row g = span.first; g < span.end(); ++g) { // without branches: the processor would guess wrong
            const double along = direction.dot(x[g] - origin);
            best = along > most ? g : best;
            most = along > most ? along : most;
        }
        return std::pair{most, best};
    };
    const auto one = farthest(block1, n), two = farthest(block2, -n);
    const Vec3 &x1 = x[one.second], &x2 = x[two.second];
    const double larger = part_of_first(model, block1, block2);
    double first = 1 - larger; // part of the place that is x1
    if (larger == 0.5) {
        const double of_one = (x1 - model.blocks.centroid[block2]).squaredNorm(), of_two = (x2 - origin).squaredNorm();
        constexpr double same = 1e-9;
        first = of_one < (1 - same) * of_two ? 1 : of_two < (1 - same) * of_one ? 0 : 0.5;
    }
    return {first * x1 + (1 - first) * x2, -two.first - one.first};
}

double gap_along(const Model& model, Row block1, Row block2, const Vec3& n, const ClosureOffset& offset) {
    double high1 = -std::numeric_limits<double>::infinity(), low2 = -high1;
    const auto& x = model.gridpoints.position;
    const Span one = model.blocks.gridpoints[block1], two = model.blocks.gridpoints[block2];
    const Vec3 origin = model.blocks.centroid[block1];
    for (Row g = one.first; g < one.end(); ++g) {
        const Vec3 from = x[g] - origin;
        high1 = std::max(high1, n.dot(from) + offset.tilt.dot(from));
    }
    for (Row g = two.first; g < two.end(); ++g) low2 = std::min(low2, n.dot(x[g] - origin));
    return low2 - high1 - offset.closure * n.dot(offset.along);
}

double gap_of_overlap(const Model& model, Row c) {
    const auto& contacts = model.contacts;
    if (contacts.depth[c] > 0) return 0;
    ClosureOffset offset = offset_of(contacts, c);
    offset.along = contacts.offset_normal[c].isZero(0) ? contacts.normal[c] : contacts.offset_normal[c];
    return std::max(0.0, gap_along(model, contacts.block1[c], contacts.block2[c], contacts.normal[c], offset));
}

} // namespace kaya
