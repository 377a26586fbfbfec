// Flat polygons in space: outlines that cross themselves, and triangles that cover a polygon.
#include "base/diagnostic.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

using Vec2 = Eigen::Vector2d;

/// Twice the signed area of a triangle.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The outline seen against its normal: anticlockwise, as in a drawing.
std::vector<Vec2> drawing_of(const std::vector<Vec3>& vertices, const std::vector<int>& loop, const Vec3& normal) {
    const Vec3 across = normal.unitOrthogonal(), up = normal.cross(across);
    std::vector<Vec2> drawing;
    const Vec3& base = vertices[loop.front()];
    for (const int v : loop) drawing.emplace_back(across.dot(vertices[v] - base), up.dot(vertices[v] - base));
    return drawing;
}

bool cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool crosses_itself(const std::vector<Vec2>& outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 2; j < count; ++j)
            if (cross(outline[i], outline[i + 1], outline[j], outline[(j + 1) % count])) return true;
    return false;
}

/// Distance of a point to the left of the line from `a` to `b`.
double left_of(const Vec2& a, const Vec2& b, const Vec2& p) { return turn(a, b, p) / (b - a).norm(); }

/// True when corner `i` of the remaining outline can be cut off: it is convex, and no other corner lies in the triangle or within `near` of
/// it. A diagonal along a straight row of corners would cross the faces beside the row by rounding.
bool is_ear(const std::vector<Vec2>& drawing, const std::vector<int>& left, std::size_t i, double near) {
    const std::size_t count = left.size();
    const Vec2 &a = drawing[left[(i + count - 1) % count]], &b = drawing[left[i]], &c = drawing[left[(i + 1) % count]];
    if (!(left_of(c, a, b) > near)) return false;
    for (const int other : left) {
        const Vec2& p = drawing[other];
        if (p == a || p == b || p == c) continue;
        if (left_of(a, b, p) >= -near && left_of(b, c, p) >= -near && left_of(c, a, p) >= -near) return false;
    }
    return true;
}

} // namespace

void check_outlines(const Surface& surface) {
    for (const auto& face : surface.faces) {
        if (face.vertices.size() < 4) continue;
        const Vec3 normal = mean_normal(surface, face);
        if (normal.isZero() || crosses_itself(drawing_of(surface.vertices, face.vertices, normal)))
            throw Diagnostic(fmt::format("the outline of {} crosses itself", face.name),
                             "give its corners in order around the face");
    }
}

std::vector<std::array<int, 3>> triangles_of(const std::vector<Vec3>& vertices, const Surface::Face& face) {
    const std::vector<Vec2> drawing = drawing_of(vertices, face.vertices, mean_normal(vertices, face.vertices));
    std::vector<int> left(face.vertices.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
    double extent = 0;
    for (const Vec2& corner : drawing) extent = std::max(extent, corner.lpNorm<Eigen::Infinity>());
    const double near = 1e-9 * extent;
    std::vector<std::array<int, 3>> triangles;
    while (left.size() > 2) {
        const std::size_t count = left.size();
        std::size_t ear = 0;
        while (ear < count && !is_ear(drawing, left, ear, near)) ++ear;
        // Without an ear only collinear corners are left; any will do.
        ear %= count;
        const auto at = [&](std::size_t i) { return face.vertices[left[i % count]]; };
        triangles.push_back({at(ear + count - 1), at(ear), at(ear + 1)});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

} // namespace kaya
