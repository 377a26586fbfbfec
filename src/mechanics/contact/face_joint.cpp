#include "mechanics/contact/face_joint.hpp"

#include "mechanics/contact/surface_shares.hpp"
#include "mechanics/shape/search_scratch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {

namespace {

/// Between half a degree and a degree and a half, the areas change smoothly from those of parallel faces to those of corners and edges, so
/// nothing jumps when the contact type changes. `parts`: which part of its place each point has.
void go_over_to_corners(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, double cosine,
                        const std::vector<double>& parts, std::vector<double>& shares) {
    constexpr double first = 0.5 * std::numbers::pi / 180, last = 3 * first;
    constexpr double cos_of_first = 0.9999619230641713;
    if (cosine >= cos_of_first) return;
    const double angle = std::acos(cosine);
    const Row block1 = model.faces.block[geometry.face1], block2 = model.faces.block[geometry.face2];
    const SurfaceShares surface(model, surfaces);
    shares.clear();
    double whole = 0;
    for (std::size_t i = 0; i < geometry.points.size(); ++i) {
        const ContactPoint& point = geometry.points[i];
        const double one = surface.of_point(block1, point.side1, geometry.normal);
        const double two = surface.of_point(block2, point.side2, -geometry.normal);
        // A vertex counts by itself; where edges cross or vertices coincide, the smaller share counts.
        const bool of_one = point.side1.weights[0] == 1, of_two = point.side2.weights[0] == 1;
        shares.push_back(parts[i] * (of_one == of_two ? std::min(one, two) : of_one ? one : two));
        whole += shares.back();
    }
    if (whole == 0) return;
    const double part = std::min(1.0, (angle - first) / (last - first)), scale = std::min(1.0, geometry.area / whole);
    geometry.area = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        double& area = geometry.points[i].area;
        area = (1 - part) * area + part * scale * shares[i];
        geometry.area += area;
    }
    geometry.points.drop_if([](const ContactPoint& point) { return !(point.area > 0); });
}

/// How far the own diagonals of a face lie in another direction than the others: the difference of their sums as squares of complex
/// numbers, since a diagonal has no sense.
Vec2 direction_of_own(const FlatFace& face) {
    Vec2 sum = Vec2::Zero();
    const auto& p = face.other.points;
    const auto& t = face.other.triangles;
    for (std::size_t i = 0; i + 1 < t.size(); i += 2) {
        const Vec2 own = p[t[i + 1][2]] - p[t[i][1]], other = p[t[i][2]] - p[t[i][0]];
        for (const auto& [d, sign] : {std::pair{own, 1.0}, std::pair{other, -1.0}})
            if (const double length = d.norm(); length > 0)
                sum += sign / length * Vec2(d.x() * d.x() - d.y() * d.y(), 2 * d.x() * d.y());
    }
    return sum;
}

/// Whether the diagonals of one face lie rather along the same ones of the other face than across them. The same for mirrored and turned
/// models, whose own diagonals may be others.
bool diagonals_agree(const FlatFace& face1, const FlatFace& face2) {
    const Vec2 one = direction_of_own(face1), two = direction_of_own(face2);
    return one.dot(two) >= -1e-9 * one.norm() * two.norm();
}

/// Makes the points of one contact from one overlay, or from two with half of the area each.
class JointPoints {
public:
    JointPoints(const Model& model, ContactGeometry& geometry, const FaceOverlay& made, const PlaneAxes& axes,
                SearchScratch& scratch)
        : model_(model), geometry_(geometry), made_(made), axes_(axes), scratch_(scratch) {
        scratch_.parts.clear();
        scratch_.places.clear();
    }

    /// Adds the overlay of the two faces on these diagonals.
    void add(bool others1, bool others2, double share) {
        const auto& [face1, face2] = scratch_.faces;
        overlay(face1.on(others1), face2.on(others2), made_.tolerance, made_.edge, scratch_.found, scratch_.overlay);
        scratch_.order = scratch_.places;
        std::ranges::sort(scratch_.order, {}, [](const auto& placed) { return placed.first.x(); });
        for (const OverlayPoint& p : scratch_.found.points) {
            ContactPoint point;
            point.side1 = face1.attach(p.place, p.vertex1, p.triangle1, p.weights1, others1);
            point.side2 = face2.attach(p.place, p.vertex2, p.triangle2, p.weights2, others2);
            complete(p, share, point);
            near_ = near_ || point.gap < made_.margin;
            geometry_.area += point.area;
            if (ContactPoint* const there = find(p.place, point)) {
                const double whole = there->area + point.area;
                there->centre += point.area / whole * (point.centre - there->centre);
                there->area = whole;
            } else {
                scratch_.places.emplace_back(p.place, geometry_.points.size());
                scratch_.parts.push_back(share);
                geometry_.points.add() = point;
            }
        }
    }

    bool near() const { return near_; }

private:
    void complete(const OverlayPoint& p, double share, ContactPoint& point) const {
        const Vec3 x1 = attached_position(model_, point.side1), x2 = attached_position(model_, point.side2);
        point.position = 0.5 * (x1 + x2);
        const Vec2 shift = p.centre - p.place;
        point.centre = point.position + shift.x() * axes_.u + shift.y() * axes_.v;
        point.gap = geometry_.normal.dot(x2 - x1);
        point.area = share * p.area;
        point.type = p.vertex1 >= 0   ? SubContactType::vertex_face
                     : p.vertex2 >= 0 ? SubContactType::face_vertex
                                      : SubContactType::edge_edge;
    }

    /// The point of an earlier overlay that moves as this one does.
    ContactPoint* find(const Vec2& place, const ContactPoint& point) {
        const double near = 2 * made_.tolerance;
        const auto& order = scratch_.order;
        auto at = std::ranges::lower_bound(order, place.x() - near, {}, [](const auto& o) { return o.first.x(); });
        for (; at != order.end() && at->first.x() <= place.x() + near; ++at) {
            ContactPoint& there = geometry_.points[at->second];
            if ((at->first - place).squaredNorm() > near * near || !on_same_gridpoints(there.side1, point.side1) ||
                !on_same_gridpoints(there.side2, point.side2))
                continue;
            scratch_.parts[at->second] = 1;
            return &there;
        }
        return nullptr;
    }

    const Model& model_;
    ContactGeometry& geometry_;
    const FaceOverlay& made_;
    const PlaneAxes& axes_;
    SearchScratch& scratch_;
    bool near_ = false;
};

} // namespace

bool intersect_faces(const Model& model, const Surfaces& surfaces, ContactGeometry& geometry, const FaceOverlay& made,
                     SearchScratch& scratch) {
    const PlaneAxes axes = axes_of(geometry.normal);
    const Row block1 = model.faces.block[geometry.face1], block2 = model.faces.block[geometry.face2];
    const Vec3 origin = surfaces.middle(block2); // keeps coordinates small
    auto& [face1, face2] = scratch.faces;
    face1.project(model, surfaces, geometry.face1, axes, origin);
    face2.project(model, surfaces, geometry.face2, axes, origin);
    const bool others1 = face1.take_other(surfaces, geometry.face1),
               others2 = face2.take_other(surfaces, geometry.face2);
    JointPoints points(model, geometry, made, axes, scratch);
    // Faces of cells are the mean of both diagonals. A rigid face has no zones that follow its triangles; it has other ones for symmetry.
    if ((others1 && model.blocks.deformable[block1]) || (others2 && model.blocks.deformable[block2])) {
        const bool crossed = others1 && others2 && !diagonals_agree(face1, face2);
        points.add(false, crossed, 0.5);
        points.add(others1, others2 && !crossed, 0.5);
    } else {
        points.add(false, false, 1);
    }
    if (!points.near()) return false;
    go_over_to_corners(model, surfaces, geometry, made.cosine, scratch.parts, scratch.shares);
    geometry.type = ContactType::face_face;
    geometry.position.setZero();
    for (const auto& point : geometry.points) geometry.position += point.area / geometry.area * point.position;
    return true;
}

} // namespace kaya
