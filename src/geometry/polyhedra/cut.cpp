#include "geometry/polyhedra/cut.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace kaya {
namespace {

// How far from the plane, in units of the last place of the coordinates, a vertex still counts as
// lying on it. A vertex made by a cut is off the planes it was made of by the rounding of its
// coordinates, a few units; off a further plane through the same line or point by as much over the
// sine of the angle between them. With a band wider than that noise, the signs around a convex face
// change twice or not at all, as they do in exact arithmetic, and planes that meet in one line or point
// share one vertex there; exact predicates on the rounded vertices would see the noise and make
// splinters of it. The band moves no vertex and is too narrow to be felt in a volume (1e-13).
constexpr double band_units = 256;

struct Side {
    double distance = 0;
    int sign = 0; ///< 0 on the plane
};

Side side_of(const Vec3& vertex, const Plane& plane, double least_band) {
    Side side;
    side.distance = plane.distance(vertex);
    const double band = std::max(least_band, band_units * std::numeric_limits<double>::epsilon() *
                                                 (vertex.lpNorm<1>() + plane.origin.lpNorm<1>()));
    if (side.distance > band) side.sign = 1;
    if (side.distance < -band) side.sign = -1;
    return side;
}

bool comes_first(const Vec3& a, const Vec3& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
}

/// Where the edge crosses the plane, reckoned from the nearer end. Does not depend on the order of
/// the ends.
Vec3 crossing(Vec3 a, double distance_a, Vec3 b, double distance_b) {
    const double reach_a = std::abs(distance_a), reach_b = std::abs(distance_b);
    if (reach_b < reach_a || (reach_b == reach_a && comes_first(b, a))) {
        std::swap(a, b);
        std::swap(distance_a, distance_b);
    }
    return a + (distance_a / (distance_a - distance_b)) * (b - a);
}

/// A new vertex on the edge between two vertices of the polyhedron that is being cut.
struct EdgePoint {
    int low = 0, high = 0;
    int vertex = 0; ///< its number among old and new vertices
};

/// The vertices of the polyhedron, followed by those of the cut.
struct CutVertices {
    std::vector<Vec3> points;
    std::vector<Side> sides;
    std::vector<EdgePoint> added;

    /// Blocks have some dozen edges, so a search from the newest is the fastest table.
    int on_edge(int a, int b) {
        const int low = std::min(a, b), high = std::max(a, b);
        for (auto point = added.rbegin(); point != added.rend(); ++point)
            if (point->low == low && point->high == high) return point->vertex;
        const int vertex = static_cast<int>(points.size());
        points.push_back(crossing(points[a], sides[a].distance, points[b], sides[b].distance));
        sides.push_back({});
        added.push_back({low, high, vertex});
        return vertex;
    }
};

/// Puts the part of `face` on the side `sign` into `part`: the vertices there and on the plane.
void clip(const Polyhedron::Face& face, int sign, CutVertices& vertices, std::vector<int>& part) {
    part.clear();
    const std::size_t count = face.vertices.size();
    for (std::size_t i = 0; i < count; ++i) {
        const int from = face.vertices[i], to = face.vertices[i + 1 == count ? 0 : i + 1];
        const int sign_from = vertices.sides[from].sign, sign_to = vertices.sides[to].sign;
        if (sign_from != -sign) part.push_back(from);
        if (sign_from * sign_to < 0) part.push_back(vertices.on_edge(from, to));
    }
}

using HalfEdge = std::array<int, 2>;

/// The faces of one piece before the cut is closed.
struct CutPiece {
    int sign = 0;
    std::vector<Polyhedron::Face> faces;
};

/// The hole of an open piece: the half-edges on the plane that have no partner, turned around and
/// joined head to tail. Empty unless they make exactly one loop.
std::vector<int> closing_loop(const CutPiece& piece, const CutVertices& vertices) {
    std::vector<HalfEdge> open;
    for (const auto& face : piece.faces) {
        int from = face.vertices.back();
        for (const int to : face.vertices) {
            if (vertices.sides[from].sign == 0 && vertices.sides[to].sign == 0) {
                const auto partner = std::find(open.begin(), open.end(), HalfEdge{from, to});
                if (partner == open.end()) {
                    open.push_back({to, from});
                } else {
                    open.erase(partner);
                }
            }
            from = to;
        }
    }
    std::vector<int> loop;
    if (open.size() < 3) return loop;
    // Begin at the lowest vertex, so that the order of the faces does not show.
    std::swap(open.front(), *std::min_element(open.begin(), open.end()));
    loop.push_back(open.front()[0]);
    int next = open.front()[1];
    while (next != loop.front()) {
        const auto edge = std::find_if(open.begin(), open.end(), [&](const HalfEdge& e) { return e[0] == next; });
        if (edge == open.end() || loop.size() == open.size()) return {};
        loop.push_back(next);
        next = (*edge)[1];
    }
    if (loop.size() != open.size()) loop.clear();
    return loop;
}

/// A polyhedron of the vertices that the faces use, numbered in their old order.
Polyhedron compact(std::vector<Polyhedron::Face>&& faces, const std::vector<Vec3>& points) {
    std::vector<int> number(points.size(), -1);
    for (const auto& face : faces)
        for (const int vertex : face.vertices) number[vertex] = 0;
    Polyhedron result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (number[i] < 0) continue;
        number[i] = static_cast<int>(result.vertices.size());
        result.vertices.push_back(points[i]);
    }
    for (auto& face : faces)
        for (int& vertex : face.vertices) vertex = number[vertex];
    result.faces = std::move(faces);
    return result;
}

/// Area-weighted normal of a loop, twice the area long.
Vec3 twice_area(const Polyhedron& polyhedron, const Polyhedron::Face& face) {
    const Vec3& base = polyhedron.vertices[face.vertices[0]];
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i)
        sum += (polyhedron.vertices[face.vertices[i]] - base).cross(polyhedron.vertices[face.vertices[i + 1]] - base);
    return sum;
}

double shortest_edge(const std::vector<int>& loop, const std::vector<Vec3>& points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop.size(); ++i)
        least = std::min(least, (points[loop[(i + 1) % loop.size()]] - points[loop[i]]).norm());
    return least;
}

} // namespace

double thickness(const Polyhedron& polyhedron) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& face : polyhedron.faces) {
        const Vec3 area = twice_area(polyhedron, face);
        const double length = area.norm();
        if (length == 0) continue;
        const Vec3& base = polyhedron.vertices[face.vertices[0]];
        double deepest = 0;
        for (const Vec3& vertex : polyhedron.vertices) deepest = std::max(deepest, -area.dot(vertex - base));
        least = std::min(least, deepest / length);
    }
    return std::isfinite(least) ? least : 0;
}

namespace {

struct CutLimits {
    double thinnest = 0, nearest = 0, band = 0;
};

Cut cut_within(const Polyhedron& polyhedron, const Plane& plane, int joint_set, const CutLimits& limits) {
    const auto& [thinnest, nearest, band] = limits;
    Cut result;
    // Most planes miss most blocks, so this first pass stores nothing.
    double highest = 0, lowest = 0;
    bool any_above = false, any_below = false, any_near = false;
    for (const Vec3& vertex : polyhedron.vertices) {
        const Side side = side_of(vertex, plane, band);
        any_above |= side.sign > 0;
        any_below |= side.sign < 0;
        any_near |= side.sign != 0 && std::abs(side.distance) < nearest;
        highest = std::max(highest, side.distance);
        lowest = std::min(lowest, side.distance);
    }
    if (!any_above || !any_below) {
        result.outcome = any_above ? CutOutcome::above : CutOutcome::below;
        return result;
    }
    if (any_near || std::min(highest, -lowest) < thinnest) {
        result.outcome = any_near ? CutOutcome::corner : CutOutcome::sliver;
        return result;
    }
    CutVertices vertices;
    vertices.points.reserve(polyhedron.vertices.size() + 8);
    vertices.sides.reserve(polyhedron.vertices.size() + 8);
    vertices.points = polyhedron.vertices;
    for (const Vec3& vertex : polyhedron.vertices) vertices.sides.push_back(side_of(vertex, plane, band));

    CutPiece above{1, {}}, below{-1, {}};
    above.faces.reserve(polyhedron.faces.size() + 1);
    below.faces.reserve(polyhedron.faces.size() + 1);
    for (const auto& face : polyhedron.faces) {
        bool face_above = false, face_below = false;
        for (const int vertex : face.vertices) {
            face_above |= vertices.sides[vertex].sign > 0;
            face_below |= vertices.sides[vertex].sign < 0;
        }
        // A face that lies within the band belongs to the lower piece: any fixed choice closes both.
        if (!face_above) below.faces.push_back(face);
        if (face_above && !face_below) above.faces.push_back(face);
        if (!face_above || !face_below) continue;
        for (CutPiece* piece : {&above, &below}) {
            Polyhedron::Face part;
            part.joint_set = face.joint_set;
            part.open = face.open;
            part.vertices.reserve(face.vertices.size() + 2);
            clip(face, piece->sign, vertices, part.vertices);
            if (part.vertices.size() > 2) piece->faces.push_back(std::move(part));
        }
    }
    Polyhedron::Face cap{closing_loop(above, vertices), joint_set};
    above.faces.push_back(cap);
    if (!cap.vertices.empty()) std::reverse(cap.vertices.begin() + 1, cap.vertices.end());
    if (cap.vertices.empty() || cap.vertices != closing_loop(below, vertices)) {
        // The plane grazes the polyhedron within the band, or a face is not flat: nothing to share.
        result.outcome = CutOutcome::sliver;
        return result;
    }
    if (nearest > 0 && shortest_edge(cap.vertices, vertices.points) < nearest) {
        result.outcome = CutOutcome::corner; // it cuts the tip off a narrow corner
        return result;
    }
    below.faces.push_back(std::move(cap));
    result.above = compact(std::move(above.faces), vertices.points);
    result.below = compact(std::move(below.faces), vertices.points);
    if (thinnest > 0 && std::min(thickness(result.above), thickness(result.below)) < thinnest)
        result = Cut{CutOutcome::sliver, {}, {}};
    return result;
}

} // namespace

Cut cut(const Polyhedron& polyhedron, const Plane& plane, int joint_set, double thinnest, double nearest) {
    return cut_within(polyhedron, plane, joint_set, {thinnest, nearest, 0});
}

std::vector<Plane> outer_planes(const Polyhedron& polyhedron) {
    std::vector<Plane> planes;
    for (const auto& face : polyhedron.faces)
        planes.push_back({face_normal(polyhedron, face), polyhedron.vertices[face.vertices[0]]});
    return planes;
}

std::vector<Vec3> section_of(const Polyhedron& piece) {
    std::vector<Vec3> section;
    for (const int v : piece.faces.back().vertices) section.push_back(piece.vertices[static_cast<std::size_t>(v)]);
    return section;
}

Cut cut_with_band(const Polyhedron& polyhedron, const Plane& plane, double band) {
    return cut_within(polyhedron, plane, 0, {0, 0, band});
}

} // namespace kaya
