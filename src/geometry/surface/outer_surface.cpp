#include "geometry/surface/outer_surface.hpp"

#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/face_contact.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/surface_repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {
namespace {

/// Of the size: parts nearer than this lie against each other, and corners are one.
constexpr double near_share = 1e-5;

using Polygon = std::vector<Vec3>;

/// No wider than `width`.
bool is_narrow(const Polygon& polygon, double width) {
    if (polygon.size() < 3) return true;
    double around = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) around += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
    return area_vector(polygon).norm() <= 0.5 * around * width;
}

/// The convex parts of a convex polygon outside of a convex outline, which runs anticlockwise about `normal`.
void cover(std::vector<Polygon>& left, const Polygon& outline, const Vec3& normal, double width) {
    std::vector<Polygon> result;
    for (Polygon& polygon : left) {
        std::vector<Polygon> outside;
        Polygon rest = polygon;
        for (std::size_t i = 0; i < outline.size() && rest.size() > 2; ++i) {
            const Vec3 outward = (outline[(i + 1) % outline.size()] - outline[i]).cross(normal).normalized();
            Polygon beyond = part_below(rest, {-outward, outline[i]});
            if (is_narrow(beyond, width)) continue;
            outside.push_back(std::move(beyond));
            rest = part_below(rest, {outward, outline[i]});
        }
        if (is_narrow(rest, width)) result.push_back(std::move(polygon)); // an edge alone
        else std::ranges::move(outside, std::back_inserter(result));
    }
    left = std::move(result);
}

} // namespace

std::optional<Surface> outer_surface(const std::vector<Polyhedron>& parts) {
    Polygon corners;
    for (const Polyhedron& part : parts) corners.insert(corners.end(), part.vertices.begin(), part.vertices.end());
    const double near = near_share * size_of(corners);
    const auto outline_of = [&](std::size_t part, std::size_t face) {
        Polygon outline;
        for (const int v : parts[part].faces[face].vertices)
            outline.push_back(parts[part].vertices[static_cast<std::size_t>(v)]);
        return outline;
    };
    std::vector<Box> boxes;
    for (const Polyhedron& part : parts) {
        const Box box = box_around(part.vertices);
        boxes.push_back({box.low - Vec3::Constant(near), box.high + Vec3::Constant(near)});
    }
    std::vector<std::vector<std::vector<Polygon>>> covers(parts.size()); // of each face, on its plane
    for (std::size_t i = 0; i < parts.size(); ++i) covers[i].resize(parts[i].faces.size());
    for (const auto& pair : overlapping_boxes(boxes)) {
        const auto one = static_cast<std::size_t>(pair[0]), other = static_cast<std::size_t>(pair[1]);
        for (const auto& [f, g] : faces_against(parts[one], parts[other], near)) {
            covers[one][f].push_back(outline_of(other, g));
            covers[other][g].push_back(outline_of(one, f));
        }
    }
    std::vector<Polygon> loops;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t f = 0; f < parts[i].faces.size(); ++f) {
            const Vec3 normal = face_normal(parts[i], parts[i].faces[f]);
            std::vector<Polygon> left{outline_of(i, f)};
            const Vec3 origin = left[0][0];
            for (Polygon& outline : covers[i][f]) {
                for (Vec3& corner : outline) corner -= normal.dot(corner - origin) * normal;
                std::ranges::reverse(outline); // it looked from the other side
                cover(left, outline, normal, near);
            }
            std::ranges::move(left, std::back_inserter(loops));
        }
    Surface surface = surface_from_loops(loops, near);
    RepairCounts counts;
    repair_surface(surface, {near, 0}, counts);
    if (!is_closed(surface)) return std::nullopt;
    return surface;
}

} // namespace kaya
