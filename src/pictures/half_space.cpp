#include "pictures/half_space.hpp"

#include "geometry/polyhedra/kept_part.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

double height(const Corner& corner, const CutPlane& plane) { return (corner.place - plane.origin).dot(plane.normal); }

Corner between(const Corner& a, const Corner& b, double part) {
    return {a.place + part * (b.place - a.place), static_cast<float>(a.value + part * (b.value - a.value))};
}

Corner crossing(const Corner& a, const Corner& b, double height_a, double height_b) {
    return between(a, b, height_a / (height_a - height_b));
}

void push(Layer& layer, const Corner& corner) {
    for (int k = 0; k < 3; ++k) layer.points.push_back(static_cast<float>(corner.place[k]));
    layer.values.push_back(corner.value);
}

} // namespace

Polygon kept_part(const Polygon& polygon, const CutPlane& plane) {
    return kept_part(
        polygon, [&](const Corner& corner) { return height(corner, plane); }, between);
}

Polygon kept_line(const Corner& from, const Corner& to, const CutPlane& plane) {
    const double first = height(from, plane), second = height(to, plane);
    if (first > 0 && second > 0) return {};
    if (first <= 0 && second <= 0) return {from, to};
    const Corner middle = crossing(from, to, first, second);
    return first <= 0 ? Polygon{from, middle} : Polygon{middle, to};
}

Polygon slice_of(const std::array<Corner, 4>& tetrahedron, const CutPlane& plane) {
    Polygon slice;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
            const double a = height(tetrahedron[i], plane), b = height(tetrahedron[j], plane);
            if ((a < 0) != (b < 0)) slice.push_back(crossing(tetrahedron[i], tetrahedron[j], a, b));
        }
    put_in_order(slice, plane.normal);
    return slice;
}

void put_in_order(Polygon& points, const Vec3& normal) {
    if (points.size() < 3) {
        points.clear();
        return;
    }
    Vec3 middle = Vec3::Zero();
    for (const Corner& corner : points) middle += corner.place / static_cast<double>(points.size());
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto angle = [&](const Corner& corner) {
        const Vec3 arm = corner.place - middle;
        return std::atan2(arm.dot(v), arm.dot(u));
    };
    std::ranges::sort(points, {}, angle);
}

void add_polygon(Layer& layer, const Polygon& polygon) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        push(layer, polygon[0]);
        push(layer, polygon[i]);
        push(layer, polygon[i + 1]);
    }
}

void add_line(Layer& layer, const Corner& from, const Corner& to) {
    push(layer, from);
    push(layer, to);
}

} // namespace kaya
