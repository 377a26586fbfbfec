#include "geometry/polygon_overlay.hpp"

#include "base/plane_cross.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

double signed_area(const std::vector<Vec2>& polygon) {
    double twice = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return 0.5 * twice;
}

/// Keeps the part left of the line from a to b (Sutherland and Hodgman 1974).
void clip(std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b, double tolerance, OverlayScratch& scratch) {
    const Vec2 along = b - a; // heights are times its length
    const double squared = along.squaredNorm(), near = tolerance * tolerance * squared;
    if (!(squared > tolerance * tolerance)) return;
    auto& heights = scratch.heights;
    auto& left = scratch.left;
    heights.clear();
    left.clear();
    bool all_left = true;
    for (const Vec2& p : polygon) {
        const double h = cross(along, p - a);
        heights.push_back(h * h <= near ? 0.0 : h);
        all_left = all_left && heights.back() >= 0;
    }
    if (all_left) return;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const std::size_t next = i + 1 == polygon.size() ? 0 : i + 1;
        const double hp = heights[i], hq = heights[next];
        if (hp >= 0) left.push_back(polygon[i]);
        if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0))
            left.push_back(polygon[i] + (polygon[next] - polygon[i]) * (hp / (hp - hq)));
    }
    polygon = left;
}

void drop_doubles(std::vector<Vec2>& polygon, double tolerance) {
    std::vector<Vec2>& p = polygon;
    for (std::size_t i = 0; i < p.size() && p.size() > 1;) {
        const std::size_t next = i + 1 == p.size() ? 0 : i + 1;
        if ((p[next] - p[i]).squaredNorm() <= 4 * tolerance * tolerance)
            p.erase(p.begin() + static_cast<std::ptrdiff_t>(next == 0 ? i : next));
        else ++i;
    }
}

/// Corners between edges of one direction are none.
void drop_straight(std::vector<Vec2>& polygon, double tolerance) {
    for (std::size_t i = 0; i < polygon.size() && polygon.size() > 3;) {
        const Vec2 &before = polygon[(i + polygon.size() - 1) % polygon.size()],
                   &after = polygon[(i + 1) % polygon.size()];
        const Vec2 along = after - before;
        const double height = cross(along, polygon[i] - before); // times the length
        if (height * height <= tolerance * tolerance * along.squaredNorm())
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
        else ++i;
    }
}

/// Area, centre and second moments about it.
struct Moments {
    double area = 0;
    Vec2 centre = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();

    explicit Moments(const std::vector<Vec2>& polygon) {
        const Vec2& origin = polygon[0];
        Vec2 first = Vec2::Zero();
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            const Vec2 a = polygon[i] - origin, b = polygon[i + 1] - origin, sum = a + b;
            const double part = 0.5 * cross(a, b);
            area += part;
            first += part / 3 * sum;
            second += part / 12 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
        }
        centre = origin + first / area;
        second -= first * first.transpose() / area;
    }
};

void add(Overlay& result, const Vec2& place, double area) {
    OverlayPoint& point = result.points.emplace_back();
    point.place = place;
    point.area = area;
}

bool is_parallelogram(const std::vector<Vec2>& p, double tolerance) {
    return p.size() == 4 && (p[0] - p[1] + p[2] - p[3]).norm() <= 4 * tolerance;
}

/// How far the points' second moments are from the exact ones, in parts of these.
double error_of(const Overlay& result, const Moments& exact) {
    Eigen::Matrix2d second = -exact.second;
    for (const auto& p : result.points)
        second += p.area * (p.place - exact.centre) * (p.place - exact.centre).transpose();
    return second.norm() / exact.second.norm();
}

/// Triangles from the centre to the edges; a rule with the corners and the centre of a triangle is exact for second
/// moments: 1/12 of it at each corner, 3/4 at its centre.
void add_fan(const std::vector<Vec2>& polygon, const Moments& exact, bool with_centres, Overlay& result) {
    const std::size_t n = polygon.size();
    for (const Vec2& p : polygon) add(result, p, 0);
    double inside = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 == n ? 0 : i + 1;
        const double area = 0.5 * cross(polygon[i] - exact.centre, polygon[next] - exact.centre);
        result.points[i].area += area / 12;
        result.points[next].area += area / 12;
        if (with_centres) add(result, (polygon[i] + polygon[next] + exact.centre) / 3, 0.75 * area);
        inside += area * (with_centres ? 1.0 / 12 : 10.0 / 12);
    }
    add(result, exact.centre, inside);
}

/// The same triangles cut in smaller ones; each corner of a small one has a third of it.
void add_fine(const std::vector<Vec2>& polygon, const Moments& exact, double edge, double tolerance, Overlay& result,
              OverlayScratch& scratch) {
    PlaneMesh mesh;
    mesh.points = polygon;
    mesh.points.push_back(exact.centre);
    const int n = static_cast<int>(polygon.size());
    for (int i = 0; i < n; ++i) mesh.triangles.push_back({n, i, (i + 1) % n});
    overlay(mesh, mesh, tolerance, edge, result, scratch);
    result.second_moment = exact.second + exact.area * exact.centre * exact.centre.transpose();
    balance_areas(result, scratch);
}

} // namespace

void common_polygon(const std::vector<Vec2>& one, const std::vector<Vec2>& two, double tolerance,
                    std::vector<Vec2>& common, OverlayScratch& scratch) {
    common = one;
    if (one.size() < 3 || two.size() < 3) return common.clear();
    if (signed_area(common) < 0) std::reverse(common.begin(), common.end());
    const bool turned = signed_area(two) < 0;
    for (std::size_t i = 0; i < two.size() && common.size() >= 3; ++i) {
        const Vec2 &a = two[i], &b = two[(i + 1) % two.size()];
        turned ? clip(common, b, a, tolerance, scratch) : clip(common, a, b, tolerance, scratch);
    }
    drop_doubles(common, tolerance);
    drop_straight(common, tolerance);
    if (common.size() < 3) return common.clear();
    Vec2 low = common[0], high = common[0];
    for (const Vec2& p : common) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    if (signed_area(common) <= tolerance * (high - low).maxCoeff()) common.clear();
}

void points_of_polygon(const std::vector<Vec2>& polygon, double edge, double tolerance, Overlay& result,
                       OverlayScratch& scratch) {
    result.points.clear();
    const Moments exact(polygon);
    if (edge > 0) return add_fine(polygon, exact, edge, tolerance, result, scratch);
    if (polygon.size() == 3 || is_parallelogram(polygon, tolerance)) {
        for (const Vec2& p : polygon) add(result, p, exact.area / 12);
        add(result, exact.centre, exact.area * (1 - static_cast<double>(polygon.size()) / 12));
        return;
    }
    constexpr double exact_enough = 1e-9;
    if (polygon.size() > 4) {
        add_fan(polygon, exact, false, result);
        result.second_moment = exact.second + exact.area * exact.centre * exact.centre.transpose();
        balance_areas(result, scratch);
        if (error_of(result, exact) <= exact_enough) return;
        result.points.clear();
    }
    add_fan(polygon, exact, true, result);
}

void corners_of_polygon(const std::vector<Vec2>& polygon, Overlay& result) {
    result.points.clear();
    for (const Vec2& p : polygon) add(result, p, 0);
    const std::size_t n = polygon.size();
    for (std::size_t apex = 0; apex < n; ++apex)
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const std::size_t b = (apex + i) % n, c = (apex + i + 1) % n;
            const double triangle = 0.5 * cross(polygon[b] - polygon[apex], polygon[c] - polygon[apex]);
            for (const std::size_t corner : {apex, b, c})
                result.points[corner].area += triangle / (3 * static_cast<double>(n));
        }
}

} // namespace kaya
