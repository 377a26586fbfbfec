#include "geometry/fractures/traces.hpp"

#include "base/stop_point.hpp"
#include "geometry/polyhedra/face_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace kaya {
namespace {

/// Sine of the angle below which two planes are parallel.
constexpr double parallel = 1e-9;

struct Line {
    Vec3 origin, direction; ///< of unit length
    Vec3 at(double s) const { return origin + s * direction; }
};

/// The line on which two planes meet; its origin is the point nearest to that of the first plane.
std::optional<Line> common_line(const Plane& a, const Plane& b) {
    const Vec3 direction = a.normal.cross(b.normal);
    const double sine = direction.norm();
    if (sine < parallel) return std::nullopt;
    const Vec3 across = direction.cross(a.normal) / sine; // in the first plane
    return Line{a.origin + b.normal.dot(b.origin - a.origin) / b.normal.dot(across) * across, direction / sine};
}

struct Stretch {
    double from, to;
};

/// The stretches of a line in the plane of a polygon that are on the polygon: between each odd crossing of its sides and the next.
std::vector<Stretch> on_polygon(const std::vector<Vec3>& polygon, const Line& line, const Vec3& normal) {
    const Vec3 across = normal.cross(line.direction);
    std::vector<double> crossings;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i] - line.origin, b = polygon[(i + 1) % polygon.size()] - line.origin;
        const double da = across.dot(a), db = across.dot(b);
        if ((da < 0) == (db < 0)) continue;
        crossings.push_back(line.direction.dot(a + da / (da - db) * (b - a)));
    }
    std::ranges::sort(crossings);
    std::vector<Stretch> stretches;
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) stretches.push_back({crossings[i], crossings[i + 1]});
    return stretches;
}

/// The stretch of a line in the plane of a fracture that is on the fracture, if it is longer than a point.
std::optional<Stretch> on_fracture(const Fracture& fracture, const Line& line, const Vec3& normal) {
    if (!fracture.corners.empty()) {
        const auto stretches = on_polygon(fracture.corners, line, normal);
        if (stretches.empty()) return std::nullopt;
        return stretches.front();
    }
    const Vec3 arm = fracture.disc.centre - line.origin;
    const double middle = line.direction.dot(arm), radius = 0.5 * fracture.disc.diameter;
    const double square = radius * radius - (arm - middle * line.direction).squaredNorm();
    if (square <= 0) return std::nullopt;
    return Stretch{middle - std::sqrt(square), middle + std::sqrt(square)};
}

/// Calls visit(line, whole trace, stretch on the polygon) for each part of a trace.
template <class Visit> void each_trace(const std::vector<Vec3>& polygon, const Fracture& fracture, Visit visit) {
    if (polygon.size() < 3) return;
    const Vec3 area = area_vector(polygon);
    if (!(area.norm() > 0)) return;
    const Plane plane{area.normalized(), polygon.front()}, own = plane_of(fracture);
    const auto line = common_line(own, plane);
    if (!line) return;
    const auto whole = on_fracture(fracture, *line, own.normal);
    if (!whole) return;
    for (const Stretch& inside : on_polygon(polygon, *line, plane.normal)) {
        const Stretch part{std::max(whole->from, inside.from), std::min(whole->to, inside.to)};
        if (part.to > part.from) visit(*line, *whole, part);
    }
}

} // namespace

std::vector<Segment> traces_on(const std::vector<Vec3>& polygon, const Fracture& fracture) {
    std::vector<Segment> traces;
    each_trace(polygon, fracture, [&](const Line& line, const Stretch&, const Stretch& part) {
        traces.push_back({line.at(part.from), line.at(part.to)});
    });
    return traces;
}

TraceMeasures trace_measures(const std::vector<std::vector<Vec3>>& polygons, const std::vector<Fracture>& fractures) {
    TraceMeasures sums;
    for (const auto& polygon : polygons) {
        sums.area += area_vector(polygon).norm();
        for (const Fracture& fracture : fractures)
            each_trace(polygon, fracture, [&](const Line&, const Stretch& whole, const Stretch& part) {
                stop_point();
                sums.length += part.to - part.from;
                ++sums.number;
                const double middle = 0.5 * (whole.from + whole.to);
                sums.centres += part.from <= middle && middle <= part.to;
            });
    }
    return sums;
}

std::vector<Intersection> intersections_of(const std::vector<Fracture>& fractures) {
    std::vector<Box> boxes;
    std::vector<Plane> planes;
    for (const Fracture& fracture : fractures) {
        boxes.push_back(box_of(fracture));
        planes.push_back(plane_of(fracture));
    }
    std::vector<Intersection> intersections;
    for (const auto& pair : overlapping_boxes(boxes)) {
        stop_point();
        const auto j = static_cast<std::size_t>(std::min(pair[0], pair[1])),
                   i = static_cast<std::size_t>(std::max(pair[0], pair[1]));
        const auto line = common_line(planes[j], planes[i]);
        if (!line) continue;
        const auto one = on_fracture(fractures[j], *line, planes[j].normal),
                   other = on_fracture(fractures[i], *line, planes[i].normal);
        if (!one || !other) continue;
        const Stretch common{std::max(one->from, other->from), std::min(one->to, other->to)};
        if (common.to > common.from) intersections.push_back({{j, i}, {line->at(common.from), line->at(common.to)}});
    }
    return intersections;
}

std::vector<std::size_t> clusters_of(std::size_t fractures, const std::vector<Intersection>& intersections) {
    std::vector<std::size_t> root(fractures);
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const Intersection& crossing : intersections) {
        const std::size_t a = find(crossing.fractures[0]), b = find(crossing.fractures[1]);
        root[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::size_t> size(fractures, 0), order;
    for (std::size_t i = 0; i < fractures; ++i) ++size[root[i] = find(i)];
    for (std::size_t i = 0; i < fractures; ++i)
        if (root[i] == i) order.push_back(i);
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return size[i]; });
    std::vector<std::size_t> number(fractures), cluster(fractures);
    for (std::size_t k = 0; k < order.size(); ++k) number[order[k]] = k;
    for (std::size_t i = 0; i < fractures; ++i) cluster[i] = number[root[i]];
    return cluster;
}

} // namespace kaya
