#include "geometry/polyhedra/face_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

std::vector<Vec3> corners_of(const Polyhedron& p, const Polyhedron::Face& face) {
    std::vector<Vec3> corners;
    for (const int v : face.vertices) corners.push_back(p.vertices[v]);
    return corners;
}

/// Calls visit(face of a, face of b) for faces that lie against each other, until it returns false.
void each_pair_against(const Polyhedron& a, const Polyhedron& b, double near, auto visit) {
    const double opposite = -std::cos(3.14159265358979 / 180);
    for (std::size_t i = 0; i < a.faces.size(); ++i) {
        const auto& face_a = a.faces[i];
        const Vec3 normal = face_normal(a, face_a);
        const Vec3& base = a.vertices[face_a.vertices[0]];
        for (std::size_t j = 0; j < b.faces.size(); ++j) {
            const auto& face_b = b.faces[j];
            if (face_normal(b, face_b).dot(normal) > opposite) continue;
            const bool far = std::any_of(face_b.vertices.begin(), face_b.vertices.end(),
                                         [&](int v) { return std::abs(normal.dot(b.vertices[v] - base)) > near; });
            if (far) continue;
            const auto outline = corners_of(a, face_a), other = corners_of(b, face_b);
            const double common = area_vector(common_part(other, outline, normal)).norm();
            if (common > 1e-6 * std::min(area_vector(outline).norm(), area_vector(other).norm()) && !visit(i, j))
                return;
        }
    }
}

} // namespace

Vec3 area_vector(const std::vector<Vec3>& polygon) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
    return 0.5 * sum;
}

std::vector<Vec3> part_below(const std::vector<Vec3>& polygon, const Plane& plane) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = plane.distance(a), db = plane.distance(b);
        if (da <= 0) part.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) part.push_back(a + da / (da - db) * (b - a));
    }
    return part;
}

std::vector<Vec3> common_part(std::vector<Vec3> polygon, const std::vector<Vec3>& outline, const Vec3& normal) {
    for (std::size_t i = 0; i < outline.size() && polygon.size() > 2; ++i) {
        const Vec3& from = outline[i];
        const Vec3 inward = normal.cross(outline[(i + 1) % outline.size()] - from);
        std::vector<Vec3> part;
        for (std::size_t j = 0; j < polygon.size(); ++j) {
            const Vec3 &a = polygon[j], &b = polygon[(j + 1) % polygon.size()];
            const double da = inward.dot(a - from), db = inward.dot(b - from);
            if (da >= 0) part.push_back(a);
            if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(a + da / (da - db) * (b - a));
        }
        polygon = std::move(part);
    }
    return polygon;
}

std::vector<std::array<std::size_t, 2>> faces_against(const Polyhedron& a, const Polyhedron& b, double near) {
    std::vector<std::array<std::size_t, 2>> pairs;
    each_pair_against(a, b, near, [&](std::size_t face_a, std::size_t face_b) {
        pairs.push_back({face_a, face_b});
        return true;
    });
    return pairs;
}

bool faces_in_contact(const Polyhedron& a, const Polyhedron& b, double near) {
    bool found = false;
    each_pair_against(a, b, near, [&](std::size_t face_a, std::size_t face_b) {
        found = !a.faces[face_a].open && !b.faces[face_b].open;
        return !found;
    });
    return found;
}

} // namespace kaya
