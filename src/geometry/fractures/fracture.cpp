#include "geometry/fractures/fracture.hpp"

#include "base/diagnostic.hpp"
#include "geometry/polyhedra/face_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace kaya {
namespace {

/// Corners off the plane, and turns the wrong way, by less than this part of the polygon's size are rounding.
constexpr double rounding = 1e-6;
/// A smaller part of a fracture's area is none.
constexpr double least_area = 1e-9;

double width_of(const std::vector<Vec3>& corners) {
    double size = 0;
    for (const Vec3& corner : corners) size = std::max(size, (corner - corners.front()).norm());
    return size;
}

/// By triangles from the first corner: near it, so that a place far from the origin costs no digits.
Vec3 centroid_of(const std::vector<Vec3>& corners, const Vec3& area) {
    Vec3 sum = Vec3::Zero();
    const Vec3 normal = area.normalized();
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3 a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
        sum += 0.5 * a.cross(b).dot(normal) * (a + b) / 3;
    }
    return corners[0] + sum / area.norm();
}

} // namespace

Fracture polygon_fracture(const std::vector<Vec3>& given) {
    if (given.size() < 3)
        throw Diagnostic(fmt::format("a polygon has three corners or more, not {}", given.size()), "give all corners");
    for (const Vec3& corner : given)
        if (!corner.allFinite()) throw Diagnostic("a corner of the polygon is not a finite number");
    const double size = width_of(given);
    Vec3 area = area_vector(given);
    if (!(area.norm() > rounding * rounding * size * size))
        throw Diagnostic("the polygon has no area", "leave it out, or look at its corners");
    Fracture fracture;
    fracture.corners = given;
    if (area.z() < 0) {
        std::ranges::reverse(fracture.corners);
        area = -area;
    }
    const Vec3 normal = area.normalized();
    const std::size_t count = given.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 &a = fracture.corners[i], &b = fracture.corners[(i + 1) % count],
                   &c = fracture.corners[(i + 2) % count];
        if (std::abs(normal.dot(a - fracture.corners[0])) > rounding * size)
            throw Diagnostic("the corners of the polygon do not lie in one plane", "divide it into triangles");
        if (normal.dot((b - a).cross(c - b)) < -rounding * size * size)
            throw Diagnostic("the polygon is not convex", "divide it into convex parts");
    }
    fracture.disc.centre = centroid_of(fracture.corners, area);
    set_normal(fracture.disc, normal);
    fracture.disc.diameter = 2 * std::sqrt(area.norm() / std::numbers::pi);
    return fracture;
}

Plane plane_of(const Fracture& fracture) {
    if (fracture.corners.empty()) return {normal_of(fracture.disc), fracture.disc.centre};
    return {area_vector(fracture.corners).normalized(), fracture.disc.centre};
}

double area_of(const Fracture& fracture) {
    return std::numbers::pi / 4 * fracture.disc.diameter * fracture.disc.diameter;
}

Box box_of(const Fracture& fracture) {
    if (!fracture.corners.empty()) return box_around(fracture.corners);
    const Vec3 normal = normal_of(fracture.disc);
    const Vec3 reach = 0.5 * fracture.disc.diameter * (1 - normal.array().square()).max(0).sqrt();
    return {fracture.disc.centre - reach, fracture.disc.centre + reach};
}

std::vector<Vec3> outline_of(const Fracture& fracture, int sides) {
    if (!fracture.corners.empty()) return fracture.corners;
    // Along the strike and up the dip. Turned about z or mirrored, the polygon follows the disc.
    const Disc& disc = fracture.disc;
    const Vec3 along = normal_from_dip(90, disc.dip_direction + 90), up = normal_of(disc).cross(along);
    const double step = 2 * std::numbers::pi / sides;
    const double radius = 0.5 * disc.diameter * std::sqrt(step / std::sin(step));
    std::vector<Vec3> outline;
    for (int k = 0; k < sides; ++k) {
        const double angle = (k + 0.5) * step;
        outline.push_back(disc.centre + radius * (std::cos(angle) * along + std::sin(angle) * up));
    }
    return outline;
}

double area_within(const Fracture& fracture, const std::vector<Vec3>& outline) {
    if (fracture.corners.empty()) return area_within(fracture.disc, outline);
    const Vec3 normal = area_vector(fracture.corners).normalized();
    std::vector<Vec3> part = outline;
    const auto& corners = fracture.corners;
    for (std::size_t i = 0; i < corners.size() && part.size() > 2; ++i)
        part = part_below(part, {(corners[(i + 1) % corners.size()] - corners[i]).cross(normal), corners[i]});
    return part.size() < 3 ? 0 : area_vector(part).norm();
}

double area_in_box(const Fracture& fracture, const Vec3& low, const Vec3& high) {
    if (fracture.corners.empty()) return area_in_box(fracture.disc, low, high);
    std::vector<Vec3> part = fracture.corners;
    for (int k = 0; k < 3 && part.size() > 2; ++k) {
        part = part_below(part, {Vec3::Unit(k), high});
        if (part.size() > 2) part = part_below(part, {-Vec3::Unit(k), low});
    }
    return part.size() < 3 ? 0 : area_vector(part).norm();
}

double distance_to(const Fracture& fracture, const Vec3& place) {
    const Plane plane = plane_of(fracture);
    const double height = plane.distance(place);
    const Vec3 foot = place - height * plane.normal;
    const auto& corners = fracture.corners;
    if (corners.empty()) {
        const double beyond = (foot - plane.origin).norm() - 0.5 * fracture.disc.diameter;
        return std::hypot(height, std::max(beyond, 0.0));
    }
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 side = corners[(i + 1) % corners.size()] - corners[i], arm = foot - corners[i];
        inside = inside && side.cross(plane.normal).dot(arm) <= 0;
        const double along = std::clamp(side.dot(arm) / side.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (arm - along * side).norm());
    }
    return std::hypot(height, inside ? 0.0 : nearest);
}

bool crosses(const Fracture& fracture, const Vec3& begin, const Vec3& end) {
    if (fracture.corners.empty()) return crosses(fracture.disc, begin, end);
    const Plane plane = plane_of(fracture);
    const double from = plane.distance(begin), to = plane.distance(end);
    if ((from < 0) == (to < 0)) return false;
    const Vec3 there = begin + from / (from - to) * (end - begin);
    const auto& corners = fracture.corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if ((corners[(i + 1) % corners.size()] - corners[i]).cross(plane.normal).dot(there - corners[i]) > 0)
            return false;
    return true;
}

double excluded_volume(double radius) { return std::pow(std::numbers::pi, 2) * std::pow(radius, 3); }

double percolation(const std::vector<Fracture>& fractures, const Vec3& low, const Vec3& high, AtSides at_sides) {
    double sum = 0;
    for (const Fracture& fracture : fractures) {
        const Box box = box_of(fracture);
        const double radius = 0.5 * fracture.disc.diameter;
        if ((box.low - low).minCoeff() >= 0 && (high - box.high).minCoeff() >= 0) {
            sum += excluded_volume(radius);
            continue;
        }
        if (at_sides == AtSides::nothing) continue;
        const double share = area_in_box(fracture, low, high) / area_of(fracture);
        sum += excluded_volume(radius * (at_sides == AtSides::area_inside ? std::sqrt(share) : share));
    }
    return sum / (high - low).prod();
}

bool cut_to_box(Fracture& fracture, const Vec3& low, const Vec3& high, int sides) {
    const Box box = box_of(fracture);
    if ((box.low - low).minCoeff() >= 0 && (high - box.high).minCoeff() >= 0) return true;
    std::vector<Vec3> part = outline_of(fracture, sides);
    const double whole = area_vector(part).norm();
    for (int k = 0; k < 3 && part.size() > 2; ++k) {
        part = part_below(part, {Vec3::Unit(k), high});
        if (part.size() > 2) part = part_below(part, {-Vec3::Unit(k), low});
    }
    if (part.size() < 3 || !(area_vector(part).norm() > least_area * whole)) return false;
    Fracture inside = polygon_fracture(part);
    fracture.disc = inside.disc;
    fracture.corners = std::move(inside.corners);
    return true;
}

namespace {

std::string_view slot_of(std::string_view group) {
    const std::size_t end = group.find('=');
    return end == group.npos ? std::string_view{} : group.substr(0, end);
}
std::string_view name_in(std::string_view group) { return group.substr(group.find('=') + 1); }

bool is_in(std::string_view own, std::string_view group) {
    return own == group || (slot_of(group).empty() && name_in(own) == group);
}

} // namespace

bool in_group(const Fracture& fracture, std::string_view group) {
    return std::ranges::any_of(fracture.groups, [&](const std::string& own) { return is_in(own, group); });
}

void set_group(Fracture& fracture, const std::string& group, bool remove) {
    std::erase_if(fracture.groups,
                  [&](const std::string& own) { return remove ? is_in(own, group) : slot_of(own) == slot_of(group); });
    if (!remove) fracture.groups.push_back(group);
}

} // namespace kaya
