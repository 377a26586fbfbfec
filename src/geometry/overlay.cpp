#include "geometry/overlay.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace kaya {

namespace {

using Polygon = std::vector<Vec2>;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners in anticlockwise order.
std::array<Vec2, 3> corners(const PlaneMesh& mesh, int triangle) {
    std::array<Vec2, 3> c;
    for (int k = 0; k < 3; ++k) c[k] = mesh.points[mesh.triangles[triangle][k]];
    if (cross(c[1] - c[0], c[2] - c[0]) < 0) std::swap(c[1], c[2]);
    return c;
}

/// The part of a convex polygon on the left of the line from a to b (Sutherland and Hodgman 1974).
/// Points within `tolerance` of the line count as on it.
void clip(Polygon& polygon, Polygon& scratch, const Vec2& a, const Vec2& b, double tolerance) {
    const Vec2 direction = b - a;
    const double length = direction.norm();
    if (length <= tolerance) return;
    scratch.clear();
    const auto height = [&](const Vec2& p) {
        const double h = cross(direction, p - a) / length;
        return std::abs(h) <= tolerance ? 0.0 : h;
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2& p = polygon[i];
        const Vec2& q = polygon[(i + 1) % polygon.size()];
        const double hp = height(p), hq = height(q);
        if (hp >= 0) scratch.push_back(p);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) scratch.push_back(p + (q - p) * (hp / (hp - hq)));
    }
    polygon.swap(scratch);
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

/// Finds the point at a place among those made so far: a grid with cells much larger than the tolerance.
class PointFinder {
public:
    PointFinder(double tolerance) : tolerance_(tolerance), cell_(16 * tolerance) {}

    int find(const std::vector<OverlayPoint>& points, const Vec2& p) const {
        const auto [ci, cj] = cell(p);
        int found = -1;
        for (std::int64_t i = ci - 1; i <= ci + 1; ++i)
            for (std::int64_t j = cj - 1; j <= cj + 1; ++j) {
                const auto range = cells_.equal_range(key(i, j));
                for (auto it = range.first; it != range.second; ++it)
                    if ((points[it->second].place - p).squaredNorm() <= 4 * tolerance_ * tolerance_ &&
                        (found < 0 || it->second < found))
                        found = it->second;
            }
        return found;
    }
    void add(const Vec2& p, int index) {
        const auto [i, j] = cell(p);
        cells_.emplace(key(i, j), index);
    }

private:
    std::array<std::int64_t, 2> cell(const Vec2& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x() / cell_)),
                static_cast<std::int64_t>(std::floor(p.y() / cell_))};
    }
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ull ^ static_cast<std::uint64_t>(j);
    }
    double tolerance_, cell_;
    std::unordered_multimap<std::uint64_t, int> cells_;
};

/// Triangles of a mesh ordered by their least x, so that pairs that cannot meet are skipped.
struct Sweep {
    struct Item {
        double low_x, high_x, low_y, high_y;
        int triangle;
    };
    std::vector<Item> items;

    explicit Sweep(const PlaneMesh& mesh) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto c = corners(mesh, static_cast<int>(t));
            items.push_back({std::min({c[0].x(), c[1].x(), c[2].x()}), std::max({c[0].x(), c[1].x(), c[2].x()}),
                             std::min({c[0].y(), c[1].y(), c[2].y()}), std::max({c[0].y(), c[1].y(), c[2].y()}),
                             static_cast<int>(t)});
        }
        std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.low_x < b.low_x; });
    }
};

} // namespace

Overlay overlay(const PlaneMesh& side1, const PlaneMesh& side2, double tolerance) {
    Overlay result;
    std::vector<OverlayPoint>& points = result.points;
    PointFinder finder(tolerance);
    const Sweep sweep1(side1), sweep2(side2);
    Polygon polygon, scratch;
    std::vector<int> ring;

    // Widest triangle of side 2: how far back in the sweep one that still meets can start.
    double widest = 0;
    for (const auto& item : sweep2.items) widest = std::max(widest, item.high_x - item.low_x);

    for (const auto& one : sweep1.items) {
        const auto first = std::lower_bound(
            sweep2.items.begin(), sweep2.items.end(), one.low_x - widest - tolerance,
            [](const Sweep::Item& item, double x) { return item.low_x < x; });
        for (auto two = first; two != sweep2.items.end() && two->low_x < one.high_x; ++two) {
            if (two->high_x <= one.low_x || two->high_y <= one.low_y || two->low_y >= one.high_y) continue;
            const auto c1 = corners(side1, one.triangle);
            const auto c2 = corners(side2, two->triangle);
            polygon.assign(c1.begin(), c1.end());
            for (int k = 0; k < 3 && polygon.size() >= 3; ++k)
                clip(polygon, scratch, c2[k], c2[(k + 1) % 3], tolerance);
            if (polygon.size() < 3) continue;

            // Points of the piece, merged with those of its neighbours.
            ring.clear();
            for (const auto& p : polygon) {
                int index = finder.find(points, p);
                if (index < 0) {
                    OverlayPoint point;
                    point.place = p;
                    point.triangle1 = one.triangle;
                    point.triangle2 = two->triangle;
                    point.vertex1 = vertex_at(side1, one.triangle, p, 2 * tolerance);
                    point.vertex2 = vertex_at(side2, two->triangle, p, 2 * tolerance);
                    point.weights1 = barycentric(side1, one.triangle, p);
                    point.weights2 = barycentric(side2, two->triangle, p);
                    index = static_cast<int>(points.size());
                    points.push_back(point);
                    finder.add(p, index);
                }
                if (ring.empty() || (ring.back() != index && ring.front() != index)) ring.push_back(index);
            }
            // Any fan integrates linear functions exactly.
            double area = 0;
            for (std::size_t i = 1; i + 1 < ring.size(); ++i)
                area += 0.5 * cross(points[ring[i]].place - points[ring[0]].place,
                                    points[ring[i + 1]].place - points[ring[0]].place);
            const double extent = std::max(one.high_x - one.low_x, one.high_y - one.low_y);
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
    std::vector<Sample> samples;
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
