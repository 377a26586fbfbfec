#include "geometry/overlay/overlay_scratch.hpp"

#include "base/plane_cross.hpp"
#include "base/vector.hpp"
#include "geometry/overlay/fans.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace kaya {

namespace {

/// A convex polygon of few corners: a triangle cut by three lines has six at most.
struct SmallPolygon {
    std::array<Vec2, 8> corners; // entries beyond `size` are not set
    int size = 0;

    SmallPolygon() = default;
    explicit SmallPolygon(const std::array<Vec2, 3>& triangle) {
        for (const auto& corner : triangle) push_back(corner);
    }
    void push_back(const Vec2& p) { corners[size++] = p; }
};

using Line = OverlayScratch::Line;
using SweepItem = OverlayScratch::SweepItem;

/// Whether a triangle lies on the right of a line, or on it.
bool on_the_right(const std::array<Vec2, 3>& corners, const Line& line, double tolerance) {
    if (line.along.isZero(0)) return false;
    double highest = cross(line.along, corners[0] - line.point);
    for (int i = 1; i < 3; ++i) highest = std::max(highest, cross(line.along, corners[i] - line.point));
    return highest <= tolerance;
}

/// Leaves the part of a convex polygon on the left of a line (Sutherland and Hodgman 1974). Points within `tolerance`
/// of the line count as on it.
void clip(SmallPolygon& polygon, const Line& line, double tolerance) {
    if (line.along.isZero(0)) return;
    std::array<double, 8> heights;
    bool all_left = true; // more often than not
    for (int i = 0; i < polygon.size; ++i) {
        const double h = cross(line.along, polygon.corners[i] - line.point);
        heights[i] = std::abs(h) <= tolerance ? 0.0 : h;
        all_left = all_left && heights[i] >= 0;
    }
    if (all_left) return;
    SmallPolygon left;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = i + 1 == polygon.size ? 0 : i + 1;
        const Vec2 &p = polygon.corners[i], &q = polygon.corners[next];
        const double hp = heights[i], hq = heights[next];
        if (hp >= 0) left.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) left.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    polygon = left;
}

std::array<double, 3> barycentric(const PlaneMesh& mesh, int triangle, const Vec2& p) {
    const auto& t = mesh.triangles[triangle];
    const Vec2 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double part = 1 / cross(b - a, c - a);
    std::array<double, 3> w{part * cross(b - p, c - p), part * cross(c - p, a - p), 0};
    for (int k = 0; k < 2; ++k) w[k] = std::clamp(w[k], 0.0, 1.0);
    w[2] = std::max(0.0, 1 - w[0] - w[1]);
    const double sum = w[0] + w[1] + w[2];
    for (auto& v : w) v /= sum;
    return w;
}

/// The vertex of a triangle that lies at p, or -1.
int vertex_at(const PlaneMesh& mesh, int triangle, const Vec2& p, double tolerance) {
    for (const int v : mesh.triangles[triangle])
        if ((mesh.points[v] - p).squaredNorm() <= tolerance * tolerance) return v;
    return -1;
}

/// Finds the point at a place among those created so far. Few points are searched directly; for many there is a grid with cells much larger
/// than the tolerance.
class PointFinder {
public:
    PointFinder(const std::vector<OverlayPoint>& points, double tolerance)
        : points_(points), tolerance_(tolerance), cell_(16 * tolerance) {}

    /// The lowest index at a place, or -1. Call it before every point that is added.
    int find(const Vec2& p) {
        if (points_.size() <= few) {
            for (std::size_t i = 0; i < points_.size(); ++i)
                if (here(i, p)) return static_cast<int>(i);
            return -1;
        }
        for (; in_grid_ < points_.size(); ++in_grid_) {
            const auto [i, j] = cell(points_[in_grid_].place);
            cells_.emplace(key(i, j), in_grid_);
        }
        const auto [ci, cj] = cell(p);
        std::size_t found = points_.size();
        for (std::int64_t i = ci - 1; i <= ci + 1; ++i)
            for (std::int64_t j = cj - 1; j <= cj + 1; ++j) {
                const auto range = cells_.equal_range(key(i, j));
                for (auto it = range.first; it != range.second; ++it)
                    if (it->second < found && here(it->second, p)) found = it->second;
            }
        return found < points_.size() ? static_cast<int>(found) : -1;
    }

private:
    static constexpr std::size_t few = 48;

    bool here(std::size_t i, const Vec2& p) const {
        return (points_[i].place - p).squaredNorm() <= 4 * tolerance_ * tolerance_;
    }
    std::array<std::int64_t, 2> cell(const Vec2& p) const {
        return {whole(std::floor(p.x() / cell_)), whole(std::floor(p.y() / cell_))};
    }
    /// Places that no cell can number, of damaged models, share one.
    static std::int64_t whole(double cell) { return std::abs(cell) < 1e18 ? static_cast<std::int64_t>(cell) : 0; }
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ull ^ static_cast<std::uint64_t>(j);
    }
    const std::vector<OverlayPoint>& points_;
    double tolerance_, cell_;
    std::size_t in_grid_ = 0;
    std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

} // namespace

SweepItem::SweepItem(const PlaneMesh& mesh, int t) : triangle(t) {
    for (int k = 0; k < 3; ++k) corners[k] = mesh.points[mesh.triangles[t][k]];
    if (cross(corners[1] - corners[0], corners[2] - corners[0]) < 0) std::swap(corners[1], corners[2]);
    low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
}

void SweepItem::find_sides(double tolerance) {
    for (int k = 0; k < 3; ++k) {
        const Vec2 direction = corners[(k + 1) % 3] - corners[k];
        const double length = direction.norm();
        if (length > tolerance) sides[k] = {corners[k], direction / length};
    }
}

namespace {

/// Triangles of a mesh ordered by their least x, so that pairs that cannot meet are skipped.
void sweep_of(const PlaneMesh& mesh, std::vector<std::pair<double, int>>& order, std::vector<SweepItem>& items) {
    order.clear(); // small, unlike the items; by number at a tie
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& c = mesh.triangles[t];
        const double low = std::min({mesh.points[c[0]].x(), mesh.points[c[1]].x(), mesh.points[c[2]].x()});
        order.emplace_back(low, static_cast<int>(t));
    }
    std::sort(order.begin(), order.end());
    items.clear();
    for (const auto& entry : order) items.emplace_back(mesh, entry.second);
}

/// Divides a triangle into n^2 equal ones with edges of about `edge`.
template <class Call> void for_parts(const std::array<Vec2, 3>& c, double edge, Call call) {
    std::array<double, 3> lengths{(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()};
    std::sort(lengths.begin(), lengths.end());
    // The longest edge is the diagonal of a rectangle more often than not.
    const int n = std::max(1, static_cast<int>(std::ceil(lengths[1] / edge - 1e-6)));
    const auto at = [&](int i, int j) { return Vec2(c[0] + (c[1] - c[0]) * i / n + (c[2] - c[0]) * j / n); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i + j < n; ++i) {
            call({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + j + 1 < n) call({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
}

/// For each triangle of side 1 the coinciding one of side 2, as on both sides of a cut: such faces are their own overlay. False if any has
/// none.
bool lie_on_each_other(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance,
                       std::vector<int>& opposite_triangles) {
    const std::size_t few = 16; // of more the sweep is as quick
    if (side1.points.size() > few || side1.points.size() != side2.points.size() ||
        side1.triangles.size() != side2.triangles.size())
        return false;
    std::array<int, few> there; // the point of side 2 at each of side 1
    for (std::size_t i = 0; i < side1.points.size(); ++i) {
        const auto same = std::find_if(side2.points.begin(), side2.points.end(), [&](const Vec2& p) {
            return (p - side1.points[i]).squaredNorm() <= tolerance * tolerance;
        });
        if (same == side2.points.end()) return false;
        there[i] = static_cast<int>(same - side2.points.begin());
    }
    opposite_triangles.clear();
    for (const auto& one : side1.triangles) {
        const auto opposite = std::find_if(side2.triangles.begin(), side2.triangles.end(), [&](const auto& two) {
            return std::all_of(one.begin(), one.end(),
                               [&](int v) { return std::find(two.begin(), two.end(), there[v]) != two.end(); });
        });
        if (opposite == side2.triangles.end()) return false;
        opposite_triangles.push_back(static_cast<int>(opposite - side2.triangles.begin()));
    }
    return true;
}

/// The parts of the triangles of side 1 within one of side 2, and their points.
class Pieces {
public:
    Pieces(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge, Overlay& result,
           std::vector<int>& ring)
        : side1_(side1), side2_(side2), tolerance_(tolerance), edge_(edge), result_(result), points_(result.points),
          finder_(result.points, tolerance), ring_(ring) {}

    void add(const SweepItem& one, int triangle2, const SmallPolygon& polygon) {
        std::vector<int>& ring = ring_;
        ring.clear();
        for (int i = 0; i < polygon.size; ++i) {
            const int index = point_at(one, triangle2, polygon.corners[i]);
            if (ring.empty() || (ring.back() != index && ring.front() != index)) ring.push_back(index);
        }
        // Any fan integrates linear functions exactly.
        double area = 0;
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
            area += 0.5 * cross(points_[ring[i]].place - points_[ring[0]].place,
                                points_[ring[i + 1]].place - points_[ring[0]].place);
        const double extent = (one.high - one.low).maxCoeff();
        if (ring.size() < 3 || area <= tolerance_ * extent) return; // its points keep area 0
        if (edge_ > 0) add_fine(one, triangle2);
        else add_fans();
    }

private:
    const PlaneMesh &side1_, &side2_;
    double tolerance_, edge_;
    Overlay& result_;
    std::vector<OverlayPoint>& points_;
    PointFinder finder_;
    std::vector<int>& ring_;

    void add_fans() {
        const std::size_t n = ring_.size(), fans = n == 3 ? 1 : n;
        for_fans(fans, n, [&](std::size_t a, std::size_t b, std::size_t c) {
            add_triangle({ring_[a], ring_[b], ring_[c]}, 1.0 / static_cast<double>(fans));
        });
    }

    /// A triangle, or those from the mean of the corners: parts that do not depend on which corner is the first.
    void add_fine(const SweepItem& one, int triangle2) {
        const auto divide = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
            for_parts({a, b, c}, edge_, [&](const std::array<Vec2, 3>& part) {
                add_triangle({point_at(one, triangle2, part[0]), point_at(one, triangle2, part[1]),
                              point_at(one, triangle2, part[2])},
                             1);
            });
        };
        const auto corner = [&](std::size_t i) { return points_[ring_[i % ring_.size()]].place; };
        if (ring_.size() == 3) return divide(corner(0), corner(1), corner(2));
        Vec2 sum = Vec2::Zero();
        for (std::size_t i = 0; i < ring_.size(); ++i) sum += corner(i);
        const Vec2 mean = sum / static_cast<double>(ring_.size());
        for (std::size_t i = 0; i < ring_.size(); ++i) divide(mean, corner(i), corner(i + 1));
    }

    /// The point here, which neighbouring pieces have in common.
    int point_at(const SweepItem& one, int triangle2, const Vec2& p) {
        const int index = finder_.find(p);
        if (index >= 0) return index;
        OverlayPoint& point = points_.emplace_back();
        point.place = p;
        point.triangle1 = one.triangle;
        point.triangle2 = triangle2;
        point.vertex1 = vertex_at(side1_, one.triangle, p, 2 * tolerance_);
        point.vertex2 = vertex_at(side2_, triangle2, p, 2 * tolerance_);
        if (point.vertex1 < 0) point.weights1 = barycentric(side1_, one.triangle, p);
        if (point.vertex2 < 0) point.weights2 = barycentric(side2_, triangle2, p);
        return static_cast<int>(points_.size()) - 1;
    }

    /// `share`: of the triangle's area.
    void add_triangle(const std::array<int, 3>& part, double share) {
        const Vec2 &a = points_[part[0]].place, &b = points_[part[1]].place, &c = points_[part[2]].place;
        const double third = share * cross(b - a, c - a) / 6.0;
        const Vec2 sum = a + b + c;
        result_.second_moment +=
            0.25 * third * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
        for (const int r : part) {
            points_[r].area += third;
            points_[r].centre += 0.25 * third * (points_[r].place + sum);
        }
    }
};

} // namespace

void overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge, Overlay& result) {
    OverlayScratch scratch;
    overlay(side1, side2, tolerance, edge, result, scratch);
}

void overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance, double edge, Overlay& result,
             OverlayScratch& scratch) {
    auto &sweep1 = scratch.sweep1, &sweep2 = scratch.sweep2;
    auto& opposite_triangles = scratch.opposite_triangles;
    std::vector<OverlayPoint>& points = result.points;
    points.clear();
    result.second_moment.setZero();
    Pieces pieces(side1, side2, tolerance, edge, result, scratch.ring);
    sweep_of(side1, scratch.order, sweep1);

    // The same result as the sweep, to the last bit.
    if (lie_on_each_other(side1, side2, tolerance, opposite_triangles)) {
        for (const auto& one : sweep1) pieces.add(one, opposite_triangles[one.triangle], SmallPolygon(one.corners));
    } else {
        sweep_of(side2, scratch.order, sweep2);
        for (auto& item : sweep2) item.find_sides(tolerance);

        // Widest triangle of side 2: how far back in the sweep one that still meets can start.
        double widest = 0;
        for (const auto& item : sweep2) widest = std::max(widest, item.high.x() - item.low.x());

        for (const auto& one : sweep1) {
            const auto first = std::lower_bound(sweep2.begin(), sweep2.end(), one.low.x() - widest - tolerance,
                                                [](const SweepItem& item, double x) { return item.low.x() < x; });
            for (auto two = first; two != sweep2.end() && two->low.x() < one.high.x(); ++two) {
                if (two->high.x() <= one.low.x() || two->high.y() <= one.low.y() || two->low.y() >= one.high.y())
                    continue;
                // Most pairs of triangles of two faces have an edge in common at most.
                if (std::any_of(two->sides.begin(), two->sides.end(),
                                [&](const Line& side) { return on_the_right(one.corners, side, tolerance); }))
                    continue;
                SmallPolygon polygon(one.corners);
                for (int k = 0; k < 3 && polygon.size >= 3; ++k) clip(polygon, two->sides[k], tolerance);
                if (polygon.size >= 3) pieces.add(one, two->triangle, polygon);
            }
        }
    }
    std::erase_if(points, [](const OverlayPoint& p) { return !(p.area > 0); });
    for (auto& point : points) point.centre /= point.area;
}

PlaneMesh radial_mesh(const PlaneMesh& mesh, FaceTriangles triangles) {
    if (triangles == FaceTriangles::fan) return mesh;
    // The outline: edges that no other triangle has.
    std::vector<std::array<int, 2>> outline;
    double whole = 0;
    Vec2 centre = Vec2::Zero();
    for (const auto& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::array<int, 2> edge{t[k], t[(k + 1) % 3]};
            const auto opposite = std::find(outline.begin(), outline.end(), std::array<int, 2>{edge[1], edge[0]});
            if (opposite == outline.end()) outline.push_back(edge);
            else outline.erase(opposite);
        }
        const Vec2 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        const double area = cross(b - a, c - a);
        whole += area;
        centre += area * (a + b + c) / 3;
    }
    PlaneMesh result;
    result.points = mesh.points;
    const int middle = static_cast<int>(result.points.size());
    result.points.emplace_back(centre / whole);
    for (const auto& edge : outline) {
        if (triangles == FaceTriangles::radial) {
            result.triangles.push_back({edge[0], edge[1], middle});
            continue;
        }
        const int half = static_cast<int>(result.points.size());
        result.points.emplace_back(0.5 * (mesh.points[edge[0]] + mesh.points[edge[1]]));
        result.triangles.push_back({edge[0], half, middle});
        result.triangles.push_back({half, edge[1], middle});
    }
    return result;
}

int triangle_at(const PlaneMesh& mesh, const Vec2& place, std::array<double, 3>& weights) {
    int best = 0;
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& corner = mesh.triangles[t];
        const Vec2 &a = mesh.points[corner[0]], &b = mesh.points[corner[1]], &c = mesh.points[corner[2]];
        const double part = 1 / cross(b - a, c - a);
        const double least = std::min({part * cross(b - place, c - place), part * cross(c - place, a - place),
                                       part * cross(a - place, b - place)});
        if (least > deepest) {
            deepest = least;
            best = static_cast<int>(t);
        }
    }
    weights = barycentric(mesh, best, place);
    return best;
}

} // namespace kaya
