#include "slopes/sliding.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace kaya {

namespace {

/// Sine of an angle below which directions count as equal: joints of one set have normals with some digits in common.
constexpr double tolerance = 1e-6;

/// Faces of equal direction count as one plane.
struct Plane {
    Vec3 outward;
    double area;
    std::vector<std::size_t> faces;
};

std::vector<Plane> planes_of(std::span<const HeldFace> faces) {
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto same = std::ranges::find_if(
            planes, [&](const Plane& plane) { return (plane.outward - faces[i].outward).norm() < tolerance; });
        if (same == planes.end()) planes.push_back({faces[i].outward, faces[i].area, {i}});
        else same->area += faces[i].area, same->faces.push_back(i);
    }
    return planes;
}

bool is_free(const Vec3& direction, const std::vector<Plane>& planes) {
    return std::ranges::all_of(
        planes, [&](const Plane& plane) { return plane.outward.dot(direction) <= tolerance * direction.norm(); });
}

/// Whether any direction leaves all planes, or slides along them.
bool has_free_direction(const std::vector<Plane>& planes) {
    bool line = false; // whether two planes meet in one
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            const Vec3 edge = planes[i].outward.cross(planes[j].outward);
            if (edge.norm() < tolerance) continue;
            line = true;
            if (is_free(edge, planes) || is_free(-edge, planes)) return true;
        }
    return !line; // parallel planes: along them
}

double strength_on(const Plane& plane, double force, std::span<const HeldFace> faces) {
    double sum = 0;
    for (const std::size_t i : plane.faces) {
        const Strength* strength = faces[i].strength;
        const double stress = force / plane.area;
        if (strength != nullptr) sum += strength->tangent(stress).at(stress) * faces[i].area;
    }
    return sum;
}

} // namespace

SlidingAnswer slide(const Vec3& force, std::span<const HeldFace> faces) {
    SlidingAnswer answer;
    const std::vector<Plane> planes = planes_of(faces);
    if (!has_free_direction(planes)) return answer;
    answer.mode = SlidingMode::at_rest;
    const double size = force.norm();
    if (!(size > 0)) return answer;

    const auto moves = [&](SlidingMode mode, const Vec3& along,
                           std::initializer_list<std::pair<const Plane*, double>> pressed) {
        answer.mode = mode;
        answer.direction = along.normalized();
        double holding = 0;
        for (const auto& [plane, normal] : pressed) {
            holding += strength_on(*plane, normal, faces);
            answer.faces.insert(answer.faces.end(), plane->faces.begin(), plane->faces.end());
        }
        answer.factor = holding / along.norm();
        return answer;
    };
    // The projection of the force on the cone of free directions is inside of it, on one of its planes, or on one of its edges.
    if (is_free(force, planes)) {
        // A force parallel to a plane makes the wedge slide along it, although the plane carries nothing.
        for (const Plane& plane : planes)
            if (plane.outward.dot(force) > -tolerance * size)
                return moves(SlidingMode::one_plane, force, {{&plane, 0.0}});
        return moves(SlidingMode::falling, force, {});
    }
    for (const Plane& plane : planes) {
        const double normal = plane.outward.dot(force);
        const Vec3 along = force - normal * plane.outward;
        if (normal > 0 && along.norm() > tolerance * size && is_free(along, planes))
            return moves(SlidingMode::one_plane, along, {{&plane, normal}});
    }
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j) {
            const Vec3 &a = planes[i].outward, &b = planes[j].outward;
            Vec3 edge = a.cross(b);
            if (edge.norm() < tolerance) continue;
            edge.normalize();
            const Vec3 along = edge.dot(force) * edge;
            if (along.norm() <= tolerance * size || !is_free(along, planes)) continue;
            // force - along = x a + y b, both pressed
            const Vec3 rest = force - along;
            const double c = a.dot(b), determinant = 1 - c * c;
            const double x = (rest.dot(a) - c * rest.dot(b)) / determinant,
                         y = (rest.dot(b) - c * rest.dot(a)) / determinant;
            if (x >= -tolerance * size && y >= -tolerance * size)
                return moves(SlidingMode::two_planes, along,
                             {{&planes[i], std::max(0.0, x)}, {&planes[j], std::max(0.0, y)}});
        }
    return answer;
}

} // namespace kaya
