#include "geometry/fractures/disc.hpp"

#include "geometry/polyhedra/plane.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace kaya {
namespace {

using Vec2 = Eigen::Vector2d;
using FlatPolygon = std::vector<Vec2>;

/// Two directions in the plane of a disc, at right angles.
struct Axes {
    Vec3 along, across;
};

Axes axes_of(const Disc& disc) {
    const Vec3 normal = normal_of(disc), along = normal.unitOrthogonal();
    return {along, normal.cross(along)};
}

/// The part of a convex polygon where normal * x <= limit.
FlatPolygon cut_off(const FlatPolygon& polygon, const Vec2& normal, double limit) {
    FlatPolygon rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double out_a = normal.dot(a) - limit, out_b = normal.dot(b) - limit;
        if (out_a <= 0) rest.push_back(a);
        if ((out_a < 0) != (out_b < 0) && out_a != out_b) rest.push_back(a + out_a / (out_a - out_b) * (b - a));
    }
    return rest;
}

/// Of the triangle from the origin to a and b; negative clockwise.
double twice_area(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of the circle's sector between two directions; negative clockwise.
double sector(const Vec2& a, const Vec2& b, double radius) {
    return 0.5 * radius * radius * std::atan2(twice_area(a, b), a.dot(b));
}

/// Common area of a circle around the origin and the triangle from there to a and b; negative clockwise.
double triangle_in_circle(const Vec2& a, const Vec2& b, double radius) {
    // Where the line from a to b is inside of the circle: from a + first * (b - a) to a + last * (b - a).
    const Vec2 side = b - a;
    const double square = side.squaredNorm();
    if (square == 0) return 0;
    const double half = -a.dot(side) / square;
    const double inside = half * half - (a.squaredNorm() - radius * radius) / square;
    if (inside <= 0) return sector(a, b, radius);
    const double first = std::max(half - std::sqrt(inside), 0.0), last = std::min(half + std::sqrt(inside), 1.0);
    if (first >= last) return sector(a, b, radius);
    const Vec2 enters = a + first * side, leaves = a + last * side;
    double area = 0.5 * twice_area(enters, leaves);
    if (first > 0) area += sector(a, enters, radius);
    if (last < 1) area += sector(leaves, b, radius);
    return area;
}

/// Of a circle around the origin and a polygon; negative clockwise.
double common_area(const FlatPolygon& polygon, double radius) {
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        area += triangle_in_circle(polygon[i], polygon[(i + 1) % polygon.size()], radius);
    return area;
}

} // namespace

Vec3 normal_of(const Disc& disc) { return normal_from_dip(disc.dip, disc.dip_direction); }

void set_normal(Disc& disc, Vec3 normal) {
    constexpr double degree = std::numbers::pi / 180;
    if (normal.z() < 0) normal = -normal;
    disc.dip = std::acos(std::min(normal.z(), 1.0)) / degree;
    disc.dip_direction = std::atan2(normal.x(), normal.y()) / degree;
    if (disc.dip_direction < 0) disc.dip_direction += 360;
}

double area_within(const Disc& disc, const std::vector<Vec3>& outline) {
    const Axes axes = axes_of(disc);
    FlatPolygon polygon;
    for (const Vec3& corner : outline) {
        const Vec3 arm = corner - disc.centre;
        polygon.emplace_back(arm.dot(axes.along), arm.dot(axes.across));
    }
    return std::abs(common_area(polygon, 0.5 * disc.diameter));
}

double area_in_box(const Disc& disc, const Vec3& low, const Vec3& high) {
    const double radius = 0.5 * disc.diameter;
    const Axes axes = axes_of(disc);
    // A square around the disc, cut by the six sides of the box.
    FlatPolygon part{
        {-2 * radius, -2 * radius}, {2 * radius, -2 * radius}, {2 * radius, 2 * radius}, {-2 * radius, 2 * radius}};
    for (int k = 0; k < 3; ++k) {
        const Vec2 rise(axes.along[k], axes.across[k]);
        part = cut_off(part, rise, high[k] - disc.centre[k]);
        part = cut_off(part, -rise, disc.centre[k] - low[k]);
    }
    return std::max(common_area(part, radius), 0.0);
}

bool crosses(const Disc& disc, const Vec3& begin, const Vec3& end) {
    const Vec3 normal = normal_of(disc);
    const double from = normal.dot(begin - disc.centre), to = normal.dot(end - disc.centre);
    if ((from < 0) == (to < 0)) return false;
    const Vec3 there = begin + from / (from - to) * (end - begin);
    return (there - disc.centre).norm() <= 0.5 * disc.diameter;
}

} // namespace kaya
