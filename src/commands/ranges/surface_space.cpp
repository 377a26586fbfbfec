#include "commands/ranges/surface_space.hpp"

#include "geometry/polyhedra/face_contact.hpp"

#include <cmath>
#include <utility>

namespace kaya {

namespace {

/// The parity of crossings of a ray in the plane, to larger first coordinates; edges take their lower end and not their upper one.
bool encloses(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& p) {
    bool inside = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Eigen::Vector2d *a = &corners[k], *b = &corners[(k + 1) % corners.size()];
        if (((*a)[1] > p[1]) == ((*b)[1] > p[1])) continue;
        if ((*a)[1] > (*b)[1]) std::swap(a, b); // so that both polygons of an edge compute the same number
        const double at = (*a)[0] + (p[1] - (*a)[1]) / ((*b)[1] - (*a)[1]) * ((*b)[0] - (*a)[0]);
        if (p[0] < at) inside = !inside;
    }
    return inside;
}

} // namespace

SurfaceRays::SurfaceRays(const PolygonSet& polygons, const Vec3& direction)
    : direction_(direction), across_(direction.unitOrthogonal()), along_(direction.cross(across_)) {
    constexpr double edge_on = 1e-9; // sine of the angle to the polygon
    for (const auto& polygon : polygons) {
        const Vec3 area = area_vector(polygon);
        const double faces = area.dot(direction_);
        if (!(std::abs(faces) > edge_on * area.norm())) continue;
        Outline outline;
        for (const Vec3& corner : polygon) outline.corners.emplace_back(across_.dot(corner), along_.dot(corner));
        outline.low = outline.high = outline.corners.front();
        for (const auto& corner : outline.corners)
            outline.low = outline.low.cwiseMin(corner), outline.high = outline.high.cwiseMax(corner);
        outline.slope = {-area.dot(across_) / faces, -area.dot(along_) / faces};
        outline.base = direction_.dot(polygon.front()) - outline.slope.dot(outline.corners.front());
        outlines_.push_back(std::move(outline));
    }
}

int SurfaceRays::crossings(const Vec3& place) const {
    const Eigen::Vector2d p(across_.dot(place), along_.dot(place));
    const double height = direction_.dot(place);
    int count = 0;
    for (const auto& outline : outlines_) {
        if ((p.array() < outline.low.array()).any() || (p.array() > outline.high.array()).any()) continue;
        if (outline.base + outline.slope.dot(p) > height && encloses(outline.corners, p)) ++count;
    }
    return count;
}

SurfaceDistance::SurfaceDistance(const PolygonSet& polygons) {
    for (const auto& polygon : polygons) {
        const Vec3 area = area_vector(polygon);
        if (!(area.norm() > 0)) continue;
        Figure figure{plane_of(polygon.front(), polygon[1] - polygon[0], area), {}, polygon.front(), polygon.front()};
        for (const Vec3& corner : polygon) {
            figure.outline.push_back(figure.plane.flat(corner));
            figure.low = figure.low.cwiseMin(corner), figure.high = figure.high.cwiseMax(corner);
        }
        figures_.push_back(std::move(figure));
    }
}

bool SurfaceDistance::within(const Vec3& place, double distance) const {
    for (const auto& figure : figures_) {
        if ((place.array() < figure.low.array() - distance).any() ||
            (place.array() > figure.high.array() + distance).any())
            continue;
        const double height = figure.plane.height(place);
        if (height > distance) continue;
        const double along = std::sqrt(distance * distance - height * height); // what is left of it in the plane
        if (inside_outline(figure.outline, figure.plane.flat(place), along)) return true;
    }
    return false;
}

} // namespace kaya
