#include "mechanics/contact/surface_shares.hpp"

#include "model/measure/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace kaya {

/// The sum of `of` the area vectors of a vertex, one for each face at it.
template <class Of> double SurfaceShares::sum_at_vertex(Row block, Row vertex, const Of& of) const {
    const auto& x = model_.gridpoints.position;
    double sum = 0;
    const Span faces = model_.blocks.faces[block];
    for (Row f = faces.first; f < faces.end(); ++f) {
        const std::span<const Row> corners = surfaces_.corners(f);
        const auto found = std::ranges::lower_bound(corners, vertex);
        if (found == corners.end() || *found != vertex) continue;
        const int own = static_cast<int>(found - corners.begin());
        Vec3 whole = Vec3::Zero(), around = Vec3::Zero();
        const auto add = [&](std::span<const std::array<int, 3>> triangles, double share) {
            for (const auto& t : triangles) {
                const Vec3 area = share * triangle_area_vector(x[corners[t[0]]], x[corners[t[1]]], x[corners[t[2]]]);
                whole += area;
                if (t[0] == own || t[1] == own || t[2] == own) around += area / 3;
            }
        };
        const auto triangles = surfaces_.triangles(f), others = surfaces_.other_triangles(f);
        const bool rigid = !model_.blocks.deformable[block], both = !rigid && !others.empty();
        add(triangles, both ? 0.5 : 1);
        if (both) add(others, 0.5);
        if (around.isZero(0)) continue;
        // The corners of a flat polygon share its area; a gridpoint of a mesh gets a third of each of its triangles.
        if (rigid) around = whole / static_cast<double>(triangles.size() + 2);
        sum += of(around);
    }
    return sum;
}

double SurfaceShares::of_vertex(Row block, Row vertex, const Vec3& outward) const {
    return sum_at_vertex(block, vertex, [&](const Vec3& around) { return std::max(0.0, around.dot(outward)); });
}

double SurfaceShares::whole_of_side(Row block, const Attachment& side) const {
    if (!model_.blocks.deformable[block]) return std::numeric_limits<double>::infinity();
    double surface = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (side.weights[k] > 0)
            surface += side.weights[k] *
                       sum_at_vertex(block, side.gridpoints[k], [](const Vec3& around) { return around.norm(); });
    return surface;
}

double SurfaceShares::of_side(Row block, const Attachment& side, const Vec3& outward) const {
    double share = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (side.weights[k] > 0) share += side.weights[k] * of_vertex(block, side.gridpoints[k], outward);
    return share;
}

double SurfaceShares::of_edge(Row block, const std::array<Row, 2>& ends, const Vec3& outward) const {
    return 0.5 * (of_vertex(block, ends[0], outward) + of_vertex(block, ends[1], outward));
}

double SurfaceShares::of_point(Row block, const Attachment& side, const Vec3& outward) const {
    constexpr double none = 1e-9;
    if (side.weights[0] == 1) return of_vertex(block, side.gridpoints[0], outward);
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(side.weights[k]) > none) continue;
        const auto [low, high] = std::minmax(side.gridpoints[(k + 1) % 3], side.gridpoints[(k + 2) % 3]);
        for (const auto& e : surfaces_.edges(block))
            if (e.ends[0] == low && e.ends[1] == high) return of_edge(block, e.ends, outward);
    }
    return 0;
}

} // namespace kaya
