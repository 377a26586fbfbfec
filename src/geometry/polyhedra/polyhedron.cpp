#include "geometry/polyhedra/polyhedron.hpp"

#include "base/diagnostic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {

MassProperties mass_properties(const Polyhedron& polyhedron) {
    // Tetrahedra from a reference point inside to every triangle of a fan over each face: the sums are
    // exact for any closed surface (Tonon 2004, J. Math. Stat. 1, for the second moments). A point near
    // the body keeps the digits of a small block far from the origin.
    Vec3 reference = Vec3::Zero();
    for (const auto& v : polyhedron.vertices) reference += v / static_cast<double>(polyhedron.vertices.size());

    double volume = 0;
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const auto& face : polyhedron.faces) {
        const Vec3 a = polyhedron.vertices[face.vertices[0]] - reference;
        for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i) {
            const Vec3 b = polyhedron.vertices[face.vertices[i]] - reference;
            const Vec3 c = polyhedron.vertices[face.vertices[i + 1]] - reference;
            const double v = a.dot(b.cross(c)) / 6.0;
            const Vec3 sum = a + b + c;
            volume += v;
            first += v / 4.0 * sum;
            second += v / 20.0 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
        }
    }
    MassProperties result;
    result.volume = volume;
    if (volume == 0) return result;
    const Vec3 offset = first / volume;
    result.centroid = reference + offset;
    const Mat3 central = second - volume * offset * offset.transpose();
    result.inertia = central.trace() * Mat3::Identity() - central;
    return result;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points) sum += point;
    return sum / static_cast<double>(points.size());
}

Polyhedron make_brick(const Vec3& corner1, const Vec3& corner2) {
    static constexpr std::array<char, 3> axes{'x', 'y', 'z'};
    for (int k = 0; k < 3; ++k) {
        if (!std::isfinite(corner1[k]) || !std::isfinite(corner2[k]))
            throw Diagnostic(fmt::format("the brick's {} limits are not finite numbers", axes[k]));
        if (corner1[k] == corner2[k])
            throw Diagnostic(fmt::format("the brick has no size in {}: both limits are {}", axes[k], corner1[k]),
                             "give two different limits");
    }
    const Vec3 lo = corner1.cwiseMin(corner2), hi = corner1.cwiseMax(corner2);
    Polyhedron brick;
    for (int i = 0; i < 8; ++i)
        brick.vertices.emplace_back(i & 1 ? hi.x() : lo.x(), i & 2 ? hi.y() : lo.y(), i & 4 ? hi.z() : lo.z());
    // Every loop starts at the face's lowest corner, so that a fan over it has the diagonal that the
    // subdivision of a brick into tetrahedra has too.
    for (const auto& loop : {std::vector{0, 2, 3, 1}, std::vector{4, 5, 7, 6}, std::vector{0, 1, 5, 4},
                             std::vector{2, 6, 7, 3}, std::vector{0, 4, 6, 2}, std::vector{1, 3, 7, 5}})
        brick.faces.push_back({loop, 0});
    return brick;
}

Vec3 face_normal(const Polyhedron& polyhedron, const Polyhedron::Face& face) {
    Vec3 sum = Vec3::Zero();
    const Vec3& a = polyhedron.vertices[face.vertices[0]];
    for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i)
        sum += (polyhedron.vertices[face.vertices[i]] - a).cross(polyhedron.vertices[face.vertices[i + 1]] - a);
    const double length = sum.norm();
    return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

} // namespace kaya
