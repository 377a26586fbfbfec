#include "model/kinds/nearest.hpp"

#include "model/measure/block_box.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaya {

namespace {

using Corners = std::array<Vec3, 3>;

double distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& place) {
    const Vec3 along = b - a;
    const double length = along.squaredNorm();
    const double at = length > 0 ? std::clamp((place - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (place - a - at * along).norm();
}

double distance_to_triangle(const Corners& corner, const Vec3& place) {
    const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    bool above = normal.squaredNorm() > 0;
    for (std::size_t k = 0; k < 3 && above; ++k)
        above = normal.dot((corner[(k + 1) % 3] - corner[k]).cross(place - corner[k])) >= 0;
    if (above) return std::abs(normal.normalized().dot(place - corner[0]));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
        least = std::min(least, distance_to_segment(corner[k], corner[(k + 1) % 3], place));
    return least;
}

/// The solid angle of a triangle seen from the place (Van Oosterom and Strackee 1983, equation 8).
double solid_angle(const Corners& corner, const Vec3& place) {
    const Vec3 a = corner[0] - place, b = corner[1] - place, c = corner[2] - place;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// Distance to a surface, 0 inside of one that is closed.
class Surface {
public:
    explicit Surface(const Vec3& place) : place_(place) {}
    void add(const Corners& corner) {
        distance_ = std::min(distance_, distance_to_triangle(corner, place_));
        angle_ += solid_angle(corner, place_);
    }
    double distance() const { return distance_; }
    double distance_of_body() const { return std::abs(angle_) > 2 * std::numbers::pi ? 0 : distance_; }

private:
    Vec3 place_;
    double distance_ = std::numeric_limits<double>::infinity(), angle_ = 0;
};

Corners corners_of(const Model& model, Row triangle) {
    const auto& rows = model.triangles.gridpoints[triangle];
    const auto& position = model.gridpoints.position;
    return {position[rows[0]], position[rows[1]], position[rows[2]]};
}

void add_triangles(const Model& model, const Span& triangles, Surface& surface) {
    for (Row t = triangles.first; t < triangles.end(); ++t) surface.add(corners_of(model, t));
}

double distance_to(const Box& box, const Vec3& place) {
    return (box.low - place).cwiseMax(place - box.high).cwiseMax(Vec3::Zero()).norm();
}

double distance_to_zone(const Model& model, Row zone, const Vec3& place) {
    static constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    const auto& rows = model.zones.gridpoints[zone];
    Surface surface(place);
    for (const auto& face : faces)
        surface.add({model.gridpoints.position[rows[face[0]]], model.gridpoints.position[rows[face[1]]],
                     model.gridpoints.position[rows[face[2]]]});
    return surface.distance_of_body();
}

} // namespace

double distance_to(const Model& model, ObjectKind kind, Row row, const Vec3& place) {
    Surface surface(place);
    if (kind == ObjectKind::block) {
        add_triangles(model, model.blocks.triangles[row], surface);
        return surface.distance_of_body();
    }
    if (kind == ObjectKind::face) {
        add_triangles(model, model.faces.triangles[row], surface);
        return surface.distance();
    }
    if (kind == ObjectKind::zone) return distance_to_zone(model, row, place);
    return (reference_point(model, kind, row) - place).norm();
}

Row nearest_row(const Model& model, ObjectKind kind, const Vec3& place) {
    constexpr double round_off = 1e-10;
    const auto rows = static_cast<Row>(count_of(model, kind));
    const bool has_size = kind == ObjectKind::block || kind == ObjectKind::face || kind == ObjectKind::zone;
    const double same = has_size ? round_off * model_size(model) : 0;
    Row best = no_row;
    double best_distance = std::numeric_limits<double>::infinity(), best_reference = best_distance;
    for (Row row = 0; row < rows; ++row) {
        if (kind == ObjectKind::block && distance_to(block_box(model, row), place) > best_distance + same) continue;
        const double distance = distance_to(model, kind, row, place);
        if (distance > best_distance + same) continue;
        const double reference = (reference_point(model, kind, row) - place).squaredNorm();
        if (distance >= best_distance - same && reference >= best_reference) continue;
        best = row;
        best_distance = std::min(distance, best_distance);
        best_reference = reference;
    }
    return best;
}

double block_size(const Model& model, Row block) {
    const Box box = block_box(model, block);
    return model.blocks.gridpoints[block].count > 0 ? (box.high - box.low).norm() : 0;
}

} // namespace kaya
