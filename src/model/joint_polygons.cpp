#include "model/joint_polygons.hpp"

#include "geometry/kept_part.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace kaya {

namespace {

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> triangles_of(const Model& model, Row face) {
    std::vector<Triangle> all;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& ids = model.triangles.gridpoints[t];
        all.push_back({model.gridpoints.position[ids[0]], model.gridpoints.position[ids[1]], model.gridpoints.position[ids[2]]});
    }
    return all;
}

bool apart(const Triangle& a, const Triangle& b, double margin) {
    for (int k = 0; k < 3; ++k) {
        const auto [low_a, high_a] = std::minmax({a[0][k], a[1][k], a[2][k]});
        const auto [low_b, high_b] = std::minmax({b[0][k], b[1][k], b[2][k]});
        if (low_a > high_b + margin || low_b > high_a + margin) return true;
    }
    return false;
}

/// Twice the area seen along the normal.
double doubled_area(std::span<const Vec3> polygon, const Vec3& normal) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 2; k < polygon.size(); ++k) sum += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
    return std::abs(sum.dot(normal));
}

/// The part of a triangle that lies above or below another one, along the normal of the joint.
std::vector<Vec3> common_part(const Triangle& a, const Triangle& b, const Vec3& normal) {
    std::vector<Vec3> polygon(a.begin(), a.end());
    const Vec3 middle = (b[0] + b[1] + b[2]) / 3;
    for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
        Vec3 outward = (b[(k + 1) % 3] - b[k]).cross(normal);
        if (outward.dot(b[k] - middle) < 0) outward = -outward;
        polygon = kept_part(
            polygon, [&](const Vec3& corner) { return outward.dot(corner - b[k]); }, [](const Vec3& from, const Vec3& to, double part) -> Vec3 { return from + part * (to - from); });
    }
    return polygon;
}

} // namespace

std::vector<std::vector<Vec3>> joint_polygons(const Model& model, Row contact) {
    const auto& contacts = model.contacts;
    std::vector<std::vector<Vec3>> parts;
    if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row) return parts;
    const double margin = model.blocks.margin[contacts.block1[contact]] + model.blocks.margin[contacts.block2[contact]];
    const auto second = triangles_of(model, contacts.face2[contact]);
    for (const Triangle& a : triangles_of(model, contacts.face1[contact]))
        for (const Triangle& b : second) {
            if (apart(a, b, margin)) continue;
            auto part = common_part(a, b, contacts.normal[contact]);
            // Triangles that share a corner or an edge have a sliver of rounding errors in common.
            if (doubled_area(part, contacts.normal[contact]) > 1e-9 * doubled_area(a, contacts.normal[contact])) parts.push_back(std::move(part));
        }
    return parts;
}

Row nearest_sub_contact(const Model& model, Row contact, const Vec3& place) {
    const Span span = model.contacts.sub_contacts[contact];
    Row best = span.first;
    double least = std::numeric_limits<double>::infinity();
    for (Row row = span.first; row < span.end(); ++row) {
        const Vec3 position = model.sub_contacts.position[row];
        const double distance = (position - place).squaredNorm();
        if (distance < least) least = distance, best = row;
    }
    return best;
}

} // namespace kaya
