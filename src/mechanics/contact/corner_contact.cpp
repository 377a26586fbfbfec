#include "mechanics/contact/corner_contact.hpp"

#include "mechanics/shape/overlap_scratch.hpp"
#include "model/measure/block_box.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace kaya {

namespace {

/// Separated blocks are pushed into each other by this many margins for the search.
constexpr double depth = 1e-3;
constexpr int most_projections = 50;

/// Clips the present polyhedron by the faces of a shifted block.
void clip_by_faces(const Model& model, const Surfaces& surfaces, Row block, const Vec3& shift, const Vec3& origin,
                   ConvexClip& clip) {
    const Span faces = model.blocks.faces[block];
    for (Row f = faces.first; f < faces.end() && !clip.empty(); ++f) {
        const Vec3& n = surfaces.normal(f);
        if (std::isfinite(surfaces.reach(f)))
            clip.clip({n, surfaces.reach(f) + n.dot(shift - origin)}, FaceOrigin::clipper);
    }
}

/// A box that encloses a shifted block.
void begin_with_box(const Model& model, Row block, const Vec3& shift, const Vec3& origin, ConvexClip& clip) {
    constexpr double room = 1.1;
    const auto [low, high] = block_box(model, block);
    const Vec3 middle = 0.5 * (low + high) + shift - origin, half = 0.5 * room * (high - low);
    clip.clear();
    for (int i = 0; i < 8; ++i)
        clip.add_vertex(middle + half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    constexpr int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& side : sides) {
        clip.begin_face();
        for (const int corner : side) clip.add_corner(corner);
    }
}

/// Barycentric weights of the point of a triangle nearest to another point (Ericson 2005, Real-Time Collision Detection, 5.1.5).
std::array<double, 3> nearest_in_triangle(const std::array<Vec3, 3>& x, const Vec3& place) {
    const Vec3 ab = x[1] - x[0], ac = x[2] - x[0], ap = place - x[0];
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const Vec3 bp = place - x[1];
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    const Vec3 cp = place - x[2];
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0, 1 - t, t};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

/// The point of a block's surface nearest to another point, on faces that look along a direction.
Attachment nearest_on_surface(const Model& model, const Surfaces& surfaces, Row block, const Vec3& place,
                              const Vec3& direction) {
    const auto& x = model.gridpoints.position;
    Attachment best;
    double least = std::numeric_limits<double>::infinity();
    const Span faces = model.blocks.faces[block];
    for (Row f = faces.first; f < faces.end(); ++f) {
        if (!(surfaces.normal(f).dot(direction) > 0)) continue;
        const Span triangles = model.faces.triangles[f];
        for (Row t = triangles.first; t < triangles.end(); ++t) {
            const auto& g = model.triangles.gridpoints[t];
            const std::array<double, 3> w = nearest_in_triangle({x[g[0]], x[g[1]], x[g[2]]}, place);
            const double square = (w[0] * x[g[0]] + w[1] * x[g[1]] + w[2] * x[g[2]] - place).squaredNorm();
            if (square < least) least = square, best = {g, w};
        }
    }
    // A vertex is stored by its first weight.
    for (std::size_t k = 1; k < 3; ++k)
        if (best.weights[k] == 1) best = {{best.gridpoints[k], best.gridpoints[k], best.gridpoints[k]}, {1, 0, 0}};
    return best;
}

/// The centroid of the common volume of both blocks after the first has been shifted.
std::optional<Vec3> middle_of_common(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                                     const Vec3& shift, ConvexClip& clip) {
    const Vec3 origin = surfaces.middle(block2); // numbers stay small
    begin_with_box(model, block1, shift, origin, clip);
    clip_by_faces(model, surfaces, block1, shift, origin, clip);
    clip_by_faces(model, surfaces, block2, Vec3::Zero(), origin, clip);
    if (clip.empty()) return std::nullopt;
    const OverlapMoments moments = moments_of(clip);
    if (!(moments.volume > 0)) return std::nullopt;
    return origin + moments.centroid;
}

/// The nearest points of two blocks, by alternating projection.
void find_nearest_places(const Model& model, const Surfaces& surfaces, Row block1, Row block2, const Vec3& normal,
                         double near, ContactPoint& point) {
    Vec3 place = surfaces.middle(block1);
    for (int i = 0; i < most_projections; ++i) {
        point.side2 = nearest_on_surface(model, surfaces, block2, place, -normal);
        if (!point.side2.attached()) return;
        point.side1 = nearest_on_surface(model, surfaces, block1, attached_position(model, point.side2), normal);
        if (!point.side1.attached()) return;
        const Vec3 next = attached_position(model, point.side1);
        if ((next - place).norm() < near) return;
        place = next;
    }
}

} // namespace

bool find_corner_contact(const Model& model, const Surfaces& surfaces, Row block1, Row block2, double distance,
                         ContactGeometry& geometry, OverlapScratch& scratch) {
    const Vec3& n = geometry.normal;
    const double push = depth * std::min(model.blocks.margin[block1], model.blocks.margin[block2]);
    const Vec3 shift = (std::max(0.0, distance) + push) * n;
    ContactPoint point;
    if (const auto place = middle_of_common(model, surfaces, block1, block2, shift, scratch.clip)) {
        point.side1 = nearest_on_surface(model, surfaces, block1, *place - shift, n);
        point.side2 = nearest_on_surface(model, surfaces, block2, *place, -n);
    } else if (distance > push) { // nearer to each other, blocks stand cornerwise
        find_nearest_places(model, surfaces, block1, block2, n, push, point);
    }
    if (!point.side1.attached() || !point.side2.attached()) return false;
    const Vec3 x1 = attached_position(model, point.side1), x2 = attached_position(model, point.side2);
    point.position = 0.5 * (x1 + x2);
    point.gap = n.dot(x2 - x1);
    point.type = SubContactType::edge_edge;
    geometry.points.add() = point;
    geometry.type = ContactType::edge_edge;
    return true;
}

} // namespace kaya
