#include "mechanics/separation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace kaya {

namespace {

/// Axes nearer to the separating one than this are not across it.
constexpr double cos_across = 0.5;

struct Support {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

Support support(const Model& model, Row block, const Vec3& axis) {
    Support s;
    const Span span = model.blocks.gridpoints[block];
    for (Row g = span.first; g < span.end(); ++g) {
        const double h = axis.dot(model.gridpoints.position[g]);
        s.low = std::min(s.low, h);
        s.high = std::max(s.high, h);
    }
    return s;
}

/// The arc between the normals of the faces at an edge.
struct Arc {
    Vec3 from, to, axis; ///< axis is the cross product of the ends
    std::array<Row, 2> ends;
};

void arcs_of(const Surfaces& surfaces, Row block, double sense, std::vector<Arc>& arcs) {
    arcs.clear();
    for (const auto& e : surfaces.edges(block)) {
        const Vec3 a = sense * surfaces.normal(e.faces[0]), b = sense * surfaces.normal(e.faces[1]);
        arcs.push_back({a, b, b.cross(a), e.ends});
    }
}

/// Only where arcs cross do the edges make a face of the Minkowski difference. The second block's normals are turned
/// round.
bool cross(const Arc& one, const Arc& two) {
    const double from = two.from.dot(one.axis), to = two.to.dot(one.axis);
    if (from * to >= 0) return false;
    const double first = one.from.dot(two.axis), last = one.to.dot(two.axis);
    return first * last < 0 && from * last > 0;
}

/// Whether a face of a block looks along a direction, or nearly so.
bool faces_along(const Model& model, const Surfaces& surfaces, Row block, const Vec3& direction, double cosine) {
    const Span faces = model.blocks.faces[block];
    for (Row f = faces.first; f < faces.end(); ++f)
        if (surfaces.normal(f).dot(direction) > cosine) return true;
    return false;
}

/// The face or the edges that gave a contact its normal.
struct OldAxis {
    Row face = no_row;
    std::array<Row, 2> edge1{no_row, no_row}, edge2{no_row, no_row};

    OldAxis(const Model& model, Row contact) {
        if (contact == no_row) return;
        const auto& contacts = model.contacts;
        const int reference = contacts.reference[contact];
        if (reference == 1) face = contacts.face1[contact];
        if (reference == 2) face = contacts.face2[contact];
        if (reference != 0 || contacts.sub_contacts[contact].count == 0) return;
        const Row s = contacts.sub_contacts[contact].first;
        const auto &one = model.sub_contacts.side1[s].gridpoints, &two = model.sub_contacts.side2[s].gridpoints;
        edge1 = {one[0], one[1]};
        edge2 = {two[0], two[1]};
    }
    bool is(Row f) const { return f == face; }
    bool is(const std::array<Row, 2>& one, const std::array<Row, 2>& two) const { return one == edge1 && two == edge2; }
};

/// How far the other block is from the plane of a face.
double distance_from(const Model& model, const Surfaces& surfaces, Row face, Row other) {
    const Vec3& n = surfaces.normal(face);
    double low = std::numeric_limits<double>::infinity();
    const Span span = model.blocks.gridpoints[other];
    for (Row g = span.first; g < span.end(); ++g) low = std::min(low, n.dot(model.gridpoints.position[g]));
    return low - surfaces.reach(face);
}

} // namespace

Separation find_separation(const Model& model, const Surfaces& surfaces, Row block1, Row block2,
                           const SeparationLimits& limits) {
    const auto [enough, tie, sliver, flat, stay, old] = limits;
    const OldAxis old_axis(model, old);
    Separation best;
    double best_score = best.distance; // distance, and more for the axis that was the best before
    static thread_local std::vector<double> at_most; // distances along the faces' normals, block 2 first
    at_most.clear();
    const Vec3 towards = model.blocks.centroid[block2] - model.blocks.centroid[block1];
    const auto try_faces = [&](bool of_first) {
        const Row own = of_first ? block1 : block2, other = of_first ? block2 : block1;
        const Vec3 to_other = of_first ? towards : Vec3(-towards);
        const Vec3& centre = model.blocks.centroid[own];
        for (Row f = model.blocks.faces[own].first; f < model.blocks.faces[own].end(); ++f) {
            const Vec3& outward = surfaces.normal(f);
            // No vertex needs to be looked at where the centroid of the other block is near enough already.
            at_most.push_back(outward.dot(to_other) + outward.dot(centre) - surfaces.reach(f));
            const double bonus = old_axis.is(f) ? stay : 0;
            if (at_most.back() + bonus <= best_score && at_most.back() <= enough) continue;
            const double distance = at_most.back() = distance_from(model, surfaces, f, other);
            if (distance > enough || distance + bonus > best_score + (best.normal.isZero(0) ? 0 : tie)) {
                best_score = distance + bonus;
                best.distance = distance;
                best.normal = of_first ? outward : Vec3(-outward);
                best.face1 = of_first ? f : no_row;
                best.face2 = of_first ? no_row : f;
            }
            if (best.distance > enough) return;
        }
    };
    const auto find_width = [&](bool of_first, std::size_t i) {
        const Span faces = model.blocks.faces[of_first ? block1 : block2];
        for (Row f = faces.first; f < faces.end(); ++f, ++i)
            if (-at_most[i] < best.width && std::abs(surfaces.normal(f).dot(best.normal)) < cos_across)
                best.width = std::min(best.width, -distance_from(model, surfaces, f, of_first ? block2 : block1));
    };
    // The lower block (block 2) first: at a tie its face gives the normal.
    try_faces(false);
    if (best.distance > enough) return best;
    // Most neighbours in a pile touch with edges and corners of faces that lie on each other: nothing to be had there.
    find_width(false, 0);
    if (best.width <= sliver && faces_along(model, surfaces, block1, best.normal, flat)) return best;
    const std::size_t of_first = at_most.size();
    try_faces(true);
    if (best.distance > enough || best.normal.isZero(0)) return best;
    best.width = std::numeric_limits<double>::infinity();
    find_width(false, 0);
    find_width(true, of_first);

    // Two faces on each other: no pair of edges separates the blocks much better.
    if (best.face1 == no_row ? faces_along(model, surfaces, block1, best.normal, flat)
                             : faces_along(model, surfaces, block2, -best.normal, flat))
        return best;

    static thread_local std::vector<Arc> arcs1, arcs2;
    arcs_of(surfaces, block1, 1, arcs1);
    arcs_of(surfaces, block2, -1, arcs2);
    const auto& x = model.gridpoints.position;
    for (const auto& e1 : arcs1) {
        const Vec3 d1 = x[e1.ends[1]] - x[e1.ends[0]];
        for (const auto& e2 : arcs2) {
            if (!cross(e1, e2)) continue;
            const Vec3 d2 = x[e2.ends[1]] - x[e2.ends[0]];
            Vec3 axis = d1.cross(d2);
            const double length = axis.norm();
            if (length <= 1e-6 * d1.norm() * d2.norm()) continue;
            axis /= length;
            if (axis.dot(towards) < 0) axis = -axis;
            const double high1 = support(model, block1, axis).high;
            if (axis.dot(x[e1.ends[0]]) < high1 - tie) continue; // not an outermost edge
            const double low2 = support(model, block2, axis).low;
            if (axis.dot(x[e2.ends[0]]) > low2 + tie) continue;
            const double distance = low2 - high1, score = distance + (old_axis.is(e1.ends, e2.ends) ? stay : 0);
            if (distance > enough || score > best_score + (best.edge1[0] == no_row ? enough : tie)) {
                best_score = score;
                best.distance = distance;
                best.normal = axis;
                best.face1 = best.face2 = no_row;
                best.edge1 = e1.ends;
                best.edge2 = e2.ends;
                if (best.distance > enough) return best;
            }
        }
    }
    return best;
}

} // namespace kaya
