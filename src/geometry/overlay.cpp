#include "geometry/overlay.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace kaya {

namespace {

/// A convex polygon of few corners: a triangle cut by three lines has six at most.
struct Polygon {
    std::array<Vec2, 8> corners;
    int size = 0;

    void push_back(const Vec2& p) { corners[size++] = p; }
};

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A line through a point, with its direction of length 1; a line too short to have one is 0.
struct Line {
    Vec2 point = Vec2::Zero(), along = Vec2::Zero();
};

/// The part of a convex polygon on the left of a line (Sutherland and Hodgman 1974). Points within `tolerance` of
/// the line count as on it.
Polygon clipped(const Polygon& polygon, const Line& line, double tolerance) {
    if (line.along.isZero(0) || polygon.size == 0) return polygon;
    const auto height = [&](const Vec2& p) {
        const double h = cross(line.along, p - line.point);
        return std::abs(h) <= tolerance ? 0.0 : h;
    };
    Polygon left;
    const double first = height(polygon.corners[0]);
    double hp = first;
    for (int i = 0; i < polygon.size; ++i) {
        const bool last = i + 1 == polygon.size;
        const Vec2& p = polygon.corners[i];
        const Vec2& q = polygon.corners[last ? 0 : i + 1];
        const double hq = last ? first : height(q);
        if (hp >= 0) left.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) left.push_back(p + (q - p) * (hp / (hp - hq)));
        hp = hq;
    }
    return left;
}

std::array<double, 3> barycentric(const PlaneMesh& mesh, int triangle, const Vec2& p) {
    const auto& t = mesh.triangles[triangle];
    const Vec2 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double whole = cross(b - a, c - a);
    std::array<double, 3> w{cross(b - p, c - p) / whole, cross(c - p, a - p) / whole, 0};
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

/// Finds the point at a place among those made so far. Few points are looked through; for many there is a grid with
/// cells much larger than the tolerance.
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
        return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
                static_cast<std::int64_t>(std::floor(p.y() / cell_))};
    }
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ull ^ static_cast<std::uint64_t>(j);
    }
    const std::vector<OverlayPoint>& points_;
    double tolerance_, cell_;
    std::size_t in_grid_ = 0;
    std::unordered_multimap<std::uint64_t, std::size_t> cells_;
};

/// A triangle of a side with its corners in anticlockwise order and its extent.
struct SweepItem {
    Vec2 low, high;
    std::array<Vec2, 3> corners;
    std::array<Line, 3> sides;
    int triangle;

    SweepItem(const PlaneMesh& mesh, int t, double tolerance) : triangle(t) {
        for (int k = 0; k < 3; ++k) corners[k] = mesh.points[mesh.triangles[t][k]];
        if (cross(corners[1] - corners[0], corners[2] - corners[0]) < 0) std::swap(corners[1], corners[2]);
        low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
        high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
        for (int k = 0; k < 3; ++k) {
            const Vec2 direction = corners[(k + 1) % 3] - corners[k];
            const double length = direction.norm();
            if (length > tolerance) sides[k] = {corners[k], direction / length};
        }
    }
};

/// Triangles of a mesh ordered by their least x, so that pairs that cannot meet are skipped.
void sweep_of(const PlaneMesh& mesh, double tolerance, std::vector<SweepItem>& items) {
    items.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) items.emplace_back(mesh, static_cast<int>(t), tolerance);
    // By number at a tie: a stable order without the memory that a stable sort takes.
    std::sort(items.begin(), items.end(), [](const SweepItem& a, const SweepItem& b) {
        return a.low.x() != b.low.x() ? a.low.x() < b.low.x() : a.triangle < b.triangle;
    });
}

} // namespace

Overlay overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance) {
    // Kept between calls, of which a search makes very many.
    static thread_local std::vector<SweepItem> sweep1, sweep2;
    static thread_local std::vector<int> ring;
    Overlay result;
    std::vector<OverlayPoint>& points = result.points;
    points.reserve(2 * (side1.points.size() + side2.points.size()));
    PointFinder finder(points, tolerance);
    sweep_of(side1, tolerance, sweep1);
    sweep_of(side2, tolerance, sweep2);

    // Widest triangle of side 2: how far back in the sweep one that still meets can start.
    double widest = 0;
    for (const auto& item : sweep2) widest = std::max(widest, item.high.x() - item.low.x());

    for (const auto& one : sweep1) {
        const auto first =
            std::lower_bound(sweep2.begin(), sweep2.end(), one.low.x() - widest - tolerance,
                             [](const SweepItem& item, double x) { return item.low.x() < x; });
        for (auto two = first; two != sweep2.end() && two->low.x() < one.high.x(); ++two) {
            if (two->high.x() <= one.low.x() || two->high.y() <= one.low.y() || two->low.y() >= one.high.y()) continue;
            Polygon polygon;
            for (const auto& corner : one.corners) polygon.push_back(corner);
            for (int k = 0; k < 3 && polygon.size >= 3; ++k)
                polygon = clipped(polygon, two->sides[k], tolerance);
            if (polygon.size < 3) continue;

            // Points of the piece, merged with those of its neighbours.
            ring.clear();
            for (int i = 0; i < polygon.size; ++i) {
                const Vec2& p = polygon.corners[i];
                int index = finder.find(p);
                if (index < 0) {
                    OverlayPoint point;
                    point.place = p;
                    point.triangle1 = one.triangle;
                    point.triangle2 = two->triangle;
                    point.vertex1 = vertex_at(side1, one.triangle, p, 2 * tolerance);
                    point.vertex2 = vertex_at(side2, two->triangle, p, 2 * tolerance);
                    if (point.vertex1 < 0) point.weights1 = barycentric(side1, one.triangle, p);
                    if (point.vertex2 < 0) point.weights2 = barycentric(side2, two->triangle, p);
                    index = static_cast<int>(points.size());
                    points.push_back(point);
                }
                if (ring.empty() || (ring.back() != index && ring.front() != index)) ring.push_back(index);
            }
            // Any fan integrates linear functions exactly.
            double area = 0;
            for (std::size_t i = 1; i + 1 < ring.size(); ++i)
                area += 0.5 * cross(points[ring[i]].place - points[ring[0]].place,
                                    points[ring[i + 1]].place - points[ring[0]].place);
            const double extent = (one.high - one.low).maxCoeff();
            if (ring.size() < 3 || area <= tolerance * extent) continue; // its points keep area 0
            for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
                const double third = cross(points[ring[i]].place - points[ring[0]].place,
                                           points[ring[i + 1]].place - points[ring[0]].place) /
                                     6.0;
                Vec2 sum = Vec2::Zero();
                for (const int r : {ring[0], ring[i], ring[i + 1]}) {
                    const Vec2& x = points[r].place;
                    points[r].area += third;
                    sum += x;
                    result.second_moment += 0.25 * third * x * x.transpose();
                }
                result.second_moment += 0.25 * third * sum * sum.transpose();
            }
        }
    }
    std::erase_if(points, [](const OverlayPoint& p) { return !(p.area > 0); });
    return result;
}

void balance_areas(Overlay& overlay) {
    auto& points = overlay.points;
    if (points.size() < 4) return; // the centre decides
    double whole = 0;
    Vec2 centre = Vec2::Zero();
    for (const auto& p : points) {
        whole += p.area;
        centre += p.area * p.place;
    }
    centre /= whole;

    // Coordinates in which the overlap's own second moments are the unit matrix: by the square root of a 2 by 2 matrix.
    const Eigen::Matrix2d exact = overlay.second_moment / whole - centre * centre.transpose();
    const double root = std::sqrt(std::max(0.0, exact.determinant()));
    if (!(root > 1e-9 * exact.trace())) return;
    const Eigen::Matrix2d whiten =
        ((exact + root * Eigen::Matrix2d::Identity()) / std::sqrt(exact.trace() + 2 * root)).inverse();

    // Two functions of second order that are to vanish in the mean: u v and u^2 - v^2.
    struct Sample {
        double weight;
        Vec2 u, f;
    };
    static thread_local std::vector<Sample> samples;
    samples.clear();
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), mixed = Eigen::Matrix2d::Zero();
    Vec2 wrong = Vec2::Zero();
    for (const auto& p : points) {
        const Vec2 u = whiten * (p.place - centre);
        const Vec2 f{u.x() * u.y(), u.x() * u.x() - u.y() * u.y()};
        const double weight = p.area / whole;
        spread += weight * u * u.transpose();
        mixed += weight * f * u.transpose();
        wrong += weight * f;
        samples.push_back({weight, u, f});
    }
    // Changes of the areas, in parts of them, that keep their sum and centre: the functions less their projections on
    // 1, x and y in the scalar product weighted with the areas.
    const Eigen::Matrix2d slope = mixed * spread.inverse();
    Eigen::Matrix2d effect = Eigen::Matrix2d::Zero();
    for (auto& s : samples) {
        s.f -= wrong + slope * s.u;
        effect += s.weight * s.f * s.f.transpose();
    }
    // Four points leave one thing to choose and not two: then the pseudo-inverse of a matrix of rank one.
    const double trace = effect.trace();
    if (wrong.norm() < 1e-12 || !(trace > 1e-9)) return;
    const Eigen::Matrix2d inverse =
        effect.determinant() > 1e-9 * trace * trace ? Eigen::Matrix2d(effect.inverse()) : effect / (trace * trace);
    const Vec2 amount = -(inverse * wrong);

    double least = 0;
    for (const auto& s : samples) least = std::min(least, amount.dot(s.f));
    constexpr double most = 0.75; // part of its area that a point may lose
    const double part = least < -most ? most / -least : 1;
    for (std::size_t i = 0; i < points.size(); ++i) points[i].area *= 1 + part * amount.dot(samples[i].f);
}

} // namespace kaya
