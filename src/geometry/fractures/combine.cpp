#include "geometry/fractures/combine.hpp"

#include "base/stop_point.hpp"
#include "geometry/polyhedra/plan_hull.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace kaya {
namespace {

/// Smaller differences of areas, in parts of the smaller area, are rounding.
constexpr double rounding = 1e-9;

/// Between two planes, in degrees; accurate for small ones.
double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180 / std::numbers::pi;
}

/// Turns the fracture about its centre into the direction of a plane, and moves it by `shift`.
void put_into(Fracture& fracture, const Fracture& larger, const Vec3& shift) {
    const Vec3 normal = plane_of(larger).normal, own = plane_of(fracture).normal, centre = fracture.disc.centre;
    const bool over = own.dot(normal) < 0; // two steep planes that dip to opposite sides
    const auto turn = Eigen::Quaterniond::FromTwoVectors(own, over ? Vec3(-normal) : normal);
    for (Vec3& corner : fracture.corners) corner = centre + shift + turn * (corner - centre);
    if (over) std::ranges::reverse(fracture.corners); // anticlockwise about the upward normal
    fracture.disc.centre = centre + shift;
    fracture.disc.dip = larger.disc.dip;
    fracture.disc.dip_direction = larger.disc.dip_direction;
}

enum class Relation { apart, overlap, inside };

/// Of a fracture to a larger one in the same plane.
Relation relation(const Fracture& smaller, const Fracture& larger) {
    if (smaller.corners.empty() && larger.corners.empty()) {
        const double apart = (smaller.disc.centre - larger.disc.centre).norm(), own = 0.5 * smaller.disc.diameter,
                     its = 0.5 * larger.disc.diameter;
        if (apart >= own + its) return Relation::apart;
        return apart + own <= its * (1 + rounding) ? Relation::inside : Relation::overlap;
    }
    const double common =
        larger.corners.empty() ? area_within(larger, smaller.corners) : area_within(smaller, larger.corners);
    const double area = area_of(smaller);
    if (common <= rounding * area) return Relation::apart;
    return common >= (1 - rounding) * area ? Relation::inside : Relation::overlap;
}

/// About its centre, to an area that is larger by `more`.
void grow(Fracture& fracture, double more) {
    const double factor = std::sqrt(1 + more / area_of(fracture));
    fracture.disc.diameter *= factor;
    for (Vec3& corner : fracture.corners) corner = fracture.disc.centre + factor * (corner - fracture.disc.centre);
}

/// Corners of a convex outline in the plan without those that change its area by no more than rounding.
std::vector<Vec3> without_flat_corners(const std::vector<Vec3>& hull) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Vec3 &before = kept.empty() ? hull.back() : kept.back(), &next = hull[(i + 1) % hull.size()];
        if (plan_cross(before, hull[i], next) > rounding * (next - before).squaredNorm()) kept.push_back(hull[i]);
    }
    return kept;
}

/// Makes a fracture the convex hull of itself and another one in its plane.
void extend(Fracture& fracture, const Fracture& other, int sides) {
    const Vec3 centre = fracture.disc.centre;
    const auto level = Eigen::Quaterniond::FromTwoVectors(plane_of(fracture).normal, Vec3::UnitZ());
    std::vector<Vec3> points;
    for (const Fracture* given : {&std::as_const(fracture), &other})
        for (const Vec3& corner : outline_of(*given, sides)) points.push_back(level * (corner - centre));
    points = without_flat_corners(plan_hull(std::move(points)));
    for (Vec3& point : points) point = centre + level.inverse() * Vec3(point.x(), point.y(), 0);
    Fracture hull = polygon_fracture(points);
    fracture.corners = std::move(hull.corners);
    fracture.disc.centre = hull.disc.centre;
    fracture.disc.diameter = hull.disc.diameter;
}

} // namespace

Combined combine(const std::vector<Fracture*>& fractures, const Combining& how) {
    using Joining = Combining::Joining;
    std::vector<Fracture*> sorted = fractures;
    std::ranges::sort(sorted, [](const Fracture* a, const Fracture* b) {
        return a->disc.diameter != b->disc.diameter ? a->disc.diameter > b->disc.diameter : a->id < b->id;
    });
    Combined result;
    std::vector<char> done(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        stop_point();
        if (done[i]) continue;
        Fracture& larger = *sorted[i];
        const Plane plane = plane_of(larger);
        for (std::size_t j = i + 1; j < sorted.size(); ++j) {
            Fracture& smaller = *sorted[j];
            const double height = plane.distance(smaller.disc.centre);
            if (done[j] || std::abs(height) > how.distance ||
                angle_between(plane.normal, plane_of(smaller).normal) > how.angle)
                continue;
            done[j] = true;
            ++result.turned;
            const bool moves = how.joining == Joining::collapse;
            put_into(smaller, larger, moves ? Vec3(-height * plane.normal) : Vec3(Vec3::Zero()));
            result.moved += moves;
            if (how.joining != Joining::merge && how.joining != Joining::hull) continue;
            Fracture moved = smaller;
            put_into(moved, larger, -height * plane.normal);
            const Relation to_larger = relation(moved, larger);
            if (to_larger == Relation::apart) continue;
            if (to_larger == Relation::overlap && how.joining == Joining::merge) grow(larger, area_of(moved));
            if (to_larger == Relation::overlap && how.joining == Joining::hull) extend(larger, moved, how.sides);
            result.taken_up.push_back(&smaller);
        }
    }
    return result;
}

} // namespace kaya
