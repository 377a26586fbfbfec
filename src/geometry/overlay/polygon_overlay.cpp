#include "geometry/overlay/polygon_overlay.hpp"

#include "base/plane_cross.hpp"
#include "geometry/overlay/fans.hpp"

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

/// Natural logarithm by exactly rounded operations: that of the C library has other last bits on some processors.
double logarithm(double x) {
    double factor = 2;
    for (; x > 1.4 || x < 0.7; factor *= 2) x = std::sqrt(x);
    const double z = (x - 1) / (x + 1), square = z * z;
    double sum = 0;
    for (int k = 17; k > 0; k -= 2) sum = sum * square + 1.0 / k;
    return factor * z * sum;
}

/// Mean distance of the polygon's area from its centre. In a triangle between the centre and an edge at the distance h the integral of the
/// distance is h^3/6 times the difference of sec tan + asinh tan of the angles at its ends.
double mean_distance(const std::vector<Vec2>& polygon, const Moments& exact) {
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 a = polygon[i] - exact.centre, b = polygon[i + 1 == polygon.size() ? 0 : i + 1] - exact.centre;
        const double length = (b - a).norm(), h = cross(a, b) / length;
        if (!(h > 0)) continue;
        const double low = a.dot(b - a) / length, high = b.dot(b - a) / length;
        const auto grown = [&](double x, double distance) { return x < 0 ? h * h / (distance - x) : distance + x; };
        const double of_angles = logarithm(grown(high, b.norm()) / grown(low, a.norm()));
        sum += h / 6 * (b.norm() * high - a.norm() * low + h * h * of_angles);
    }
    return sum / exact.area;
}

/// A unit vector along a principal axis of a symmetric matrix, or along `wanted` where there is none.
Vec2 principal_axis(const Eigen::Matrix2d& m, const Vec2& wanted) {
    constexpr double isotropic = 1e-6;
    const double mixed = 2 * m(0, 1), differs = m(0, 0) - m(1, 1), size = std::sqrt(mixed * mixed + differs * differs);
    if (size <= isotropic * m.trace()) return wanted.normalized();
    const double cosine = differs / size; // of twice the angle
    return {std::sqrt(std::max(0.0, 0.5 * (1 + cosine))),
            std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - cosine))), mixed)};
}

/// The largest x for which a - x b has no negative eigenvalue; b is positive definite.
double largest_multiple(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) {
    const Eigen::Matrix2d ratio = a.inverse() * b;
    const double half = 0.5 * ratio.trace();
    return 1 / (half + std::sqrt(std::max(0.0, half * half - ratio.determinant())));
}

/// The corners share the part f of the area, and four places inside the rest: on the principal axes of what the corners leave of the second
/// moments, at equal distances from the centre. f is the part with which the mean distance from the centre, the resistance of friction
/// against twisting, is that of the polygon: docs/theory/contacts.md, (3) and (3a).
void add_corners_and_four(const std::vector<Vec2>& polygon, const Moments& exact, Overlay& result) {
    constexpr double most = 0.95; // of the part that leaves nothing to the four in one direction
    corners_of_polygon(polygon, result);
    const Eigen::Matrix2d second = exact.second / exact.area;
    Eigen::Matrix2d of_corners = Eigen::Matrix2d::Zero();
    double distance = 0;
    for (const auto& p : result.points) {
        const Vec2 arm = p.place - exact.centre;
        distance += p.area / exact.area * arm.norm();
        of_corners += p.area / exact.area * arm * arm.transpose();
    }
    const double wanted = mean_distance(polygon, exact), square = second.trace();
    const double a = of_corners.trace() - distance * distance, b = square + of_corners.trace() - 2 * wanted * distance,
                 c = square - wanted * wanted; // a f^2 - b f + c = 0, none of them negative
    const double f = std::min(2 * c / (b + std::sqrt(std::max(0.0, b * b - 4 * a * c))),
                              most * largest_multiple(second, of_corners));
    const Eigen::Matrix2d rest = (second - f * of_corners) / (1 - f);
    const Vec2 u = principal_axis(rest, polygon[1] - polygon[0]), v(-u.y(), u.x());
    const Vec2 along = std::sqrt(std::max(0.0, u.dot(rest * u))) * u,
               across = std::sqrt(std::max(0.0, v.dot(rest * v))) * v;
    for (auto& p : result.points) p.area *= f;
    for (const Vec2& place : {Vec2(along + across), Vec2(across - along), Vec2(-along - across), Vec2(along - across)})
        add(result, exact.centre + place, 0.25 * (1 - f) * exact.area);
}

/// Triangles from the centre to the edges, cut in smaller ones; each corner of a small one has a third of it.
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
    add_corners_and_four(polygon, exact, result);
}

void corners_of_polygon(const std::vector<Vec2>& polygon, Overlay& result) {
    result.points.clear();
    for (const Vec2& p : polygon) add(result, p, 0);
    const std::size_t n = polygon.size();
    for_fans(n, n, [&](std::size_t a, std::size_t b, std::size_t c) {
        const double triangle = 0.5 * cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
        for (const std::size_t corner : {a, b, c})
            result.points[corner].area += triangle / (3 * static_cast<double>(n));
    });
}

} // namespace kaya
