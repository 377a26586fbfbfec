#include "geometry/mesh/face_mesh.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/mesh/graded_points.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {
namespace {

using Vec2 = Eigen::Vector2d;
using Triangle = std::array<int, 3>;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// 1 for an equilateral triangle, near 0 for a flat one, below 0 for one that is turned over.
double quality(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return squares > 0 ? 2 * std::numbers::sqrt3 * cross(b - a, c - a) / squares : 0;
}

/// The outline in its own plane.
struct Drawing {
    Vec3 origin, along, across;
    std::vector<Vec2> points; ///< as in FaceMesh
    std::size_t fixed = 0;    ///< points of the outline come first
    std::vector<int> loop;    ///< all of them in order around
    std::vector<Vec2> corners;
    Vec2 longest_begin, longest; ///< the longest edge
    std::size_t longest_parts = 1;

    explicit Drawing(const FaceOutline& outline) {
        const auto& corner = outline.corners;
        const std::size_t count = corner.size();
        Vec3 normal = Vec3::Zero();
        std::size_t first = 0;
        double length = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 side = corner[(i + 1) % count] - corner[i];
            normal += (corner[i] - corner[0]).cross(side);
            if (side.norm() <= length * (1 + 1e-9)) continue;
            length = side.norm();
            first = i;
        }
        origin = corner[first];
        along = (corner[(first + 1) % count] - origin).normalized();
        across = normal.cross(along).normalized();
        const auto place = [&](const Vec3& x) { return Vec2((x - origin).dot(along), (x - origin).dot(across)); };
        for (const Vec3& x : corner) corners.push_back(place(x));
        points = corners;
        for (std::size_t i = 0; i < count; ++i) {
            loop.push_back(static_cast<int>(i));
            for (const Vec3& x : outline.between[i]) {
                loop.push_back(static_cast<int>(points.size()));
                points.push_back(place(x));
            }
        }
        fixed = points.size();
        longest_begin = corners[first];
        longest = corners[(first + 1) % count] - corners[first];
        longest_parts = outline.between[first].size() + 1;
    }

    /// How far a place is from the nearest edge, below 0 outside.
    double depth(const Vec2& p) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec2 side = corners[(i + 1) % corners.size()] - corners[i];
            least = std::min(least, cross(side, p - corners[i]) / side.norm());
        }
        return least;
    }
    Vec3 in_space(const Vec2& p) const { return origin + p.x() * along + p.y() * across; }
};

std::vector<Triangle> delaunay_triangles(const std::vector<Vec2>& points, const std::vector<int>& loop) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
    using Storage = CGAL::Triangulation_data_structure_2<Vertex, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
    using Triangulation =
        CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, CGAL::No_constraint_intersection_tag>;
    Triangulation triangulation;
    std::vector<Triangulation::Vertex_handle> handles;
    Triangulation::Face_handle near;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto vertex = triangulation.insert({points[i].x(), points[i].y()}, near);
        vertex->info() = static_cast<int>(i);
        near = vertex->face();
        handles.push_back(vertex);
    }
    try {
        for (std::size_t i = 0; i < loop.size(); ++i)
            triangulation.insert_constraint(handles[loop[i]], handles[loop[(i + 1) % loop.size()]]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
        throw Diagnostic("the outline of a face crosses itself",
                         "the corners of the block are not those that it was cut with: restore an earlier save");
    }
    // Points of one edge can form triangles without area outside the outline: those that exist in the loop only and turn against it.
    std::vector<int> place(points.size(), -1);
    for (std::size_t i = 0; i < loop.size(); ++i) place[loop[i]] = static_cast<int>(i);
    std::vector<Triangle> triangles;
    for (const auto face : triangulation.finite_face_handles()) {
        Triangle t{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
        std::rotate(t.begin(), std::ranges::min_element(t), t.end());
        const std::array<int, 3> p{place[t[0]], place[t[1]], place[t[2]]};
        if (p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && (p[0] < p[1]) + (p[1] < p[2]) + (p[2] < p[0]) < 2) continue;
        triangles.push_back(t);
    }
    std::ranges::sort(triangles);
    return triangles;
}

/// Triangles that are made better by moving points inside and by turning edges.
class Improvable {
public:
    Improvable(const Drawing& drawing, std::vector<Vec2> points, std::vector<Triangle> triangles)
        : points_(std::move(points)), triangles_(std::move(triangles)), fixed_(drawing.fixed) {}

    void improve() {
        constexpr int most_rounds = 8;
        for (int round = 0; round < most_rounds; ++round) {
            bool changed = turn_edges();
            changed |= move_points();
            if (!changed) break;
        }
    }
    double worst() const {
        double least = 1;
        for (const Triangle& t : triangles_) least = std::min(least, quality_of(t));
        return least;
    }
    const std::vector<Vec2>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

private:
    static constexpr double wanted = 0.85, least_gain = 1e-4;

    double quality_of(const Triangle& t) const { return quality(points_[t[0]], points_[t[1]], points_[t[2]]); }

    bool move_points() {
        std::vector<std::vector<int>> around(points_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (const int v : triangles_[t]) around[v].push_back(static_cast<int>(t));
        bool changed = false;
        for (std::size_t v = fixed_; v < points_.size(); ++v) changed |= move_point(v, around[v]);
        return changed;
    }

    bool move_point(std::size_t v, const std::vector<int>& around) {
        const auto worst_around = [&](double floor) {
            double least = 1;
            for (const int t : around) {
                least = std::min(least, quality_of(triangles_[t]));
                if (least <= floor) break;
            }
            return least;
        };
        double best = worst_around(-2);
        if (best >= wanted) return false;
        const double start = best;
        const Triangle& any = triangles_[around.front()];
        const double reach = (points_[any[0]] - points_[any[1]]).norm();
        for (double step = 0.2 * reach; step > 0.01 * reach;) {
            const Vec2 here = points_[v];
            Vec2 target = here;
            for (std::size_t i = 0; i < 8; ++i) {
                static const double half = std::sqrt(0.5);
                static const std::array<Vec2, 8> directions{Vec2(1, 0),        Vec2(half, half), Vec2(0, 1),
                                                            Vec2(-half, half), Vec2(-1, 0),      Vec2(-half, -half),
                                                            Vec2(0, -1),       Vec2(half, -half)};
                points_[v] = here + step * directions[i];
                const double least = worst_around(best + least_gain);
                if (least <= best + least_gain) continue;
                best = least;
                target = points_[v];
            }
            points_[v] = target;
            if (target == here) step /= 2;
        }
        return best > start;
    }

    /// Swaps the diagonal of two triangles where that improves the worse one.
    bool turn_edges() {
        std::vector<std::array<int, 4>> edges; // lower, higher point, triangle, corner opposite
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (int k = 0; k < 3; ++k) {
                const int a = triangles_[t][(k + 1) % 3], b = triangles_[t][(k + 2) % 3];
                edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), k});
            }
        std::ranges::sort(edges);
        std::vector<bool> used(triangles_.size(), false);
        bool changed = false;
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            if (edges[i][0] != edges[i + 1][0] || edges[i][1] != edges[i + 1][1]) continue;
            const int t = edges[i][2], u = edges[i + 1][2];
            if (used[t] || used[u]) continue;
            const int c = triangles_[t][edges[i][3]], d = triangles_[u][edges[i + 1][3]];
            const int a = triangles_[t][(edges[i][3] + 1) % 3], b = triangles_[t][(edges[i][3] + 2) % 3];
            const Triangle first{c, a, d}, second{c, d, b};
            const double now = std::min(quality_of(triangles_[t]), quality_of(triangles_[u]));
            if (std::min(quality_of(first), quality_of(second)) <= now + least_gain) continue;
            triangles_[t] = first;
            triangles_[u] = second;
            used[t] = used[u] = changed = true;
        }
        return changed;
    }

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
    std::size_t fixed_;
};

/// A lattice of equilateral triangles with rows along the longest edge.
struct Lattice {
    double clearance; ///< from the outline, in parts of the edge
    bool on_edge;     ///< continues from the points of the longest edge; else centred on the face
};

std::vector<Vec2> lattice_points(const Drawing& drawing, double edge, const Lattice& lattice) {
    Vec2 low = drawing.corners.front(), high = low, centre = Vec2::Zero();
    for (const Vec2& c : drawing.corners) {
        low = low.cwiseMin(c);
        high = high.cwiseMax(c);
        centre += c / static_cast<double>(drawing.corners.size());
    }
    double step = edge;
    Vec2 anchor = centre;
    if (lattice.on_edge) {
        // Not all edges can be divided evenly; take the spacing of the longest one where it is near.
        anchor = drawing.longest_begin;
        step =
            std::clamp(drawing.longest.norm() / static_cast<double>(drawing.longest_parts), 0.85 * edge, 1.15 * edge);
    }
    const double height = std::sqrt(0.75) * step;
    std::vector<Vec2> points;
    const int first_row = static_cast<int>(std::floor((low.y() - anchor.y()) / height)),
              last_row = static_cast<int>(std::ceil((high.y() - anchor.y()) / height)),
              first = static_cast<int>(std::floor((low.x() - anchor.x()) / step)) - 1,
              last = static_cast<int>(std::ceil((high.x() - anchor.x()) / step));
    StopPoints stops;
    for (int row = first_row; row <= last_row; ++row)
        for (int column = first; column <= last; ++column) {
            stops.pass();
            const Vec2 p = anchor + Vec2((column + (row % 2 ? 0.5 : 0)) * step, row * height);
            if (drawing.depth(p) >= lattice.clearance * edge) points.push_back(p);
        }
    return points;
}

/// In the drawing's plane.
Spacing spacing_on(const Drawing& drawing, const FaceOutline& outline, const EdgeField& field) {
    /// Edge parts shorter than this part of the field's length are fine ones, imposed by a neighbour.
    constexpr double fine = 0.55;
    Spacing spacing{[&drawing, field](const Vec3& p) {
                        return field.at(drawing.in_space({p.x(), p.y()}));
                    },
                    field.change(),
                    {}};
    std::size_t next = outline.corners.size();
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
        const auto& between = outline.between[i];
        for (std::size_t k = 0; k < between.size(); ++k, ++next) {
            const Vec3& before = k > 0 ? between[k - 1] : outline.corners[i];
            const Vec3& after =
                k + 1 < between.size() ? between[k + 1] : outline.corners[(i + 1) % outline.corners.size()];
            const double length = 0.5 * ((between[k] - before).norm() + (after - between[k]).norm());
            const Vec2& p = drawing.points[next];
            if (length < fine * field.at(between[k])) spacing.finer.push_back({{p.x(), p.y(), 0}, length});
        }
    }
    return spacing;
}

std::vector<Vec2> graded_points_of(const Drawing& drawing, const Spacing& spacing, double clearance) {
    Vec2 low = drawing.corners.front(), high = low;
    for (const Vec2& c : drawing.corners) {
        low = low.cwiseMin(c);
        high = high.cwiseMax(c);
    }
    const Room room{[&](const Vec3& p) { return drawing.depth({p.x(), p.y()}); }, clearance};
    std::vector<Vec2> points;
    for (const Vec3& p : graded_points({low.x(), low.y(), 0}, {high.x(), high.y(), 0}, spacing, room))
        points.emplace_back(p.x(), p.y());
    return points;
}

} // namespace

FaceMesh mesh_face(const FaceOutline& outline, const EdgeField& field) {
    const Drawing drawing(outline);
    /// Above this quality of the worst triangle no better ones are needed: angles of some 35 degrees.
    constexpr double good = 0.85;
    constexpr std::array trials{Lattice{0.6, true},  Lattice{0.6, false}, Lattice{0.5, true},
                                Lattice{0.5, false}, Lattice{0.75, true}, Lattice{0.75, false}};
    const Spacing spacing = spacing_on(drawing, outline, field);
    const bool graded = !field.even() || !spacing.finer.empty();
    std::vector<Vec2> best_points, before;
    std::vector<Triangle> best_triangles;
    double best = -std::numeric_limits<double>::infinity();
    for (const Lattice& lattice : trials) {
        if (best >= good) break;
        std::vector<Vec2> points = drawing.points;
        const std::vector<Vec2> inside = graded ? graded_points_of(drawing, spacing, lattice.clearance)
                                                : lattice_points(drawing, field.edge, lattice);
        points.insert(points.end(), inside.begin(), inside.end());
        if (!best_triangles.empty() && points.size() == before.size() && points == before) continue;
        before = points;
        Improvable mesh(drawing, points, delaunay_triangles(points, drawing.loop));
        mesh.improve();
        const double worst = mesh.worst();
        if (worst <= best) continue;
        best = worst;
        best_points = mesh.points();
        best_triangles = mesh.triangles();
    }
    FaceMesh mesh;
    mesh.points = outline.corners;
    for (const auto& points : outline.between) mesh.points.insert(mesh.points.end(), points.begin(), points.end());
    for (std::size_t i = drawing.fixed; i < best_points.size(); ++i)
        mesh.points.push_back(drawing.in_space(best_points[i]));
    mesh.triangles = std::move(best_triangles);
    return mesh;
}

} // namespace kaya
