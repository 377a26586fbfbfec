// A concave solid as convex parts.
//
// The faces are sorted into a tree of half spaces (binary space partition: Fuchs, Kedem and Naylor 1980;
// Thibault and Naylor 1987 for solids): the plane of one face splits both the present space, a convex
// polyhedron, and the other faces; where no face is left, the space is inside or outside as the last
// plane says. All pieces are convex all the way, so the cutting of convex polyhedra with its tolerance
// does the whole work.
#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/cut.hpp"
#include "geometry/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace kaya {
namespace {

/// A convex piece of a face.
struct Fragment {
    std::vector<Vec3> corners;
    Plane plane;
};

struct Sides {
    std::vector<Fragment> front, back;
    int split = 0; ///< fragments on both sides
};

/// The part of the polygon on the side `sign` of the plane.
std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Plane& plane, double sign) {
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * plane.distance(a), db = sign * plane.distance(b);
        if (da >= 0) part.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) part.push_back(a + da / (da - db) * (b - a));
    }
    return part;
}

/// Range of distances of the corners from the plane.
std::pair<double, double> reach(const Fragment& fragment, const Plane& plane) {
    double low = 0, high = 0;
    for (const Vec3& corner : fragment.corners) {
        const double distance = plane.distance(corner);
        low = std::min(low, distance);
        high = std::max(high, distance);
    }
    return {low, high};
}

Sides sort_sides(const std::vector<Fragment>& fragments, const Plane& plane, double near) {
    Sides sides;
    for (const Fragment& fragment : fragments) {
        const auto [low, high] = reach(fragment, plane);
        if (low >= -near && high <= near) continue; // in the plane: represented by the node itself
        if (low >= -near) {
            sides.front.push_back(fragment);
        } else if (high <= near) {
            sides.back.push_back(fragment);
        } else {
            ++sides.split;
            sides.front.push_back({clip(fragment.corners, plane, 1), fragment.plane});
            sides.back.push_back({clip(fragment.corners, plane, -1), fragment.plane});
        }
    }
    return sides;
}

/// The plane that splits the fewest faces; the first of equals.
Plane best_plane(const std::vector<Fragment>& fragments, double near) {
    constexpr std::size_t most_tried = 200;
    const std::size_t step = 1 + fragments.size() / most_tried;
    std::size_t best = 0;
    int fewest = static_cast<int>(fragments.size()) + 1;
    for (std::size_t i = 0; i < fragments.size() && fewest > 0; i += step) {
        stop_point();
        int split = 0;
        for (const Fragment& other : fragments) {
            const auto [low, high] = reach(other, fragments[i].plane);
            split += low < -near && high > near;
        }
        if (split < fewest) {
            fewest = split;
            best = i;
        }
    }
    return fragments[best].plane;
}

/// A piece of space with the faces in it, still to be decided.
struct Cell {
    Polyhedron space;
    std::vector<Fragment> fragments;
};

std::vector<Polyhedron> inside_cells(Cell&& whole, double near) {
    std::vector<Polyhedron> inside;
    std::vector<Cell> waiting;
    waiting.push_back(std::move(whole));
    while (!waiting.empty()) {
        Cell cell = std::move(waiting.back());
        waiting.pop_back();
        const Plane plane = best_plane(cell.fragments, near);
        Sides sides = sort_sides(cell.fragments, plane, near);
        Cut halves = cut(cell.space, plane, 0, near);
        const bool has_front = halves.outcome == CutOutcome::cut || halves.outcome == CutOutcome::above;
        const bool has_back = halves.outcome != CutOutcome::above;
        if (halves.outcome == CutOutcome::above) halves.above = cell.space;
        if (halves.outcome == CutOutcome::below || halves.outcome == CutOutcome::sliver) halves.below = cell.space;
        if (has_back && sides.back.empty()) inside.push_back(halves.below);
        if (has_back && !sides.back.empty()) waiting.push_back({std::move(halves.below), std::move(sides.back)});
        if (has_front && !sides.front.empty()) waiting.push_back({std::move(halves.above), std::move(sides.front)});
    }
    return inside;
}

std::vector<Fragment> fragments_of(const Surface& surface) {
    std::vector<Fragment> fragments;
    for (const auto& face : surface.faces) {
        const Plane plane{mean_normal(surface, face), mean_point(surface, face)};
        for (const auto& t : triangles_of(surface.vertices, face))
            fragments.push_back({{surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]}, plane});
    }
    return fragments;
}

/// Restores the given vertices bit for bit where cutting has returned to them.
void snap(Polyhedron& part, const std::vector<Vec3>& vertices, double near) {
    for (Vec3& v : part.vertices)
        for (const Vec3& given : vertices)
            if ((v - given).lpNorm<Eigen::Infinity>() <= near) {
                v = given;
                break;
            }
}

bool covers(const Surface& surface, const Surface::Face& face, const Vec3& point) {
    const Vec3 normal = mean_normal(surface, face);
    for (const auto& t : triangles_of(surface.vertices, face)) {
        bool within = true;
        for (int i = 0; i < 3; ++i) {
            const Vec3 &a = surface.vertices[t[i]], &b = surface.vertices[t[(i + 1) % 3]];
            within = within && normal.dot((b - a).cross(point - a)) >= 0;
        }
        if (within) return true;
    }
    return false;
}

/// Cutting loses the joint set of a face; the given face that covers it still has it.
void restore_joint_sets(std::vector<Polyhedron>& parts, const Surface& surface, double near) {
    for (const auto& given : surface.faces) {
        if (given.joint_set == 0) continue;
        const Plane plane{mean_normal(surface, given), mean_point(surface, given)};
        for (Polyhedron& part : parts)
            for (auto& face : part.faces) {
                if (face_normal(part, face).dot(plane.normal) < 1 - 1e-6) continue;
                Vec3 centre = Vec3::Zero();
                for (const int v : face.vertices)
                    centre += part.vertices[v] / static_cast<double>(face.vertices.size());
                if (std::abs(plane.distance(centre)) <= near && covers(surface, given, centre))
                    face.joint_set = given.joint_set;
            }
    }
}

} // namespace

std::vector<Polyhedron> convex_parts(const Surface& surface) {
    constexpr std::size_t most_faces = 5000;
    if (surface.faces.size() > most_faces)
        throw Diagnostic(
            fmt::format("the concave surface has {} faces, too many to split into convex parts", surface.faces.size()),
            fmt::format("simplify it to at most {} faces", most_faces));
    const double size = size_of(surface.vertices), near = 1e-8 * size;
    Vec3 low = surface.vertices.front(), high = low;
    for (const Vec3& v : surface.vertices) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    const Vec3 margin = Vec3::Constant(0.1 * size);
    std::vector<Polyhedron> parts =
        inside_cells({make_brick(low - margin, high + margin), fragments_of(surface)}, near);

    double volume = 0;
    for (Polyhedron& part : parts) {
        snap(part, surface.vertices, 10 * near);
        volume += mass_properties(part).volume;
    }
    Polyhedron whole;
    whole.vertices = surface.vertices;
    for (const auto& face : surface.faces)
        for (const auto& t : triangles_of(surface.vertices, face)) whole.faces.push_back({{t[0], t[1], t[2]}, 0});
    const double wanted = mass_properties(whole).volume;
    if (parts.empty() || std::abs(volume - wanted) > 1e-6 * wanted)
        throw Diagnostic("the concave surface could not be split into convex parts",
                         "give it as convex blocks and join them");
    restore_joint_sets(parts, surface, 10 * near);
    return parts;
}

} // namespace kaya
