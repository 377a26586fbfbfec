// A concave solid as convex parts.
//
// The faces are sorted into a tree of half spaces (binary space partition: Fuchs, Kedem and Naylor 1980;
// Thibault and Naylor 1987 for solids): the plane of one face splits both the present space, a convex
// polyhedron, and the other faces. Where no face is left, the space is a part if the surface winds around
// it once. The last plane alone could not tell: slivers of faces, which rounding makes, have planes too.
// All pieces are convex all the way, so the cutting of convex polyhedra with its tolerance does the whole
// work.
#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/polyhedra/cut.hpp"
#include "geometry/surface/space_partition.hpp"
#include "geometry/surface/surface_checks.hpp"
#include "geometry/surface/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {
namespace {

/// Thinner than `near`: by volume over area, because faces that rounding makes have no directions.
bool is_sliver(const Polyhedron& space, double near) {
    double largest = 0;
    for (const auto& face : space.faces) {
        const Vec3& base = space.vertices[face.vertices[0]];
        Vec3 twice_area = Vec3::Zero();
        for (std::size_t i = 2; i < face.vertices.size(); ++i)
            twice_area += (space.vertices[face.vertices[i - 1]] - base).cross(space.vertices[face.vertices[i]] - base);
        largest = std::max(largest, twice_area.norm() / 2);
    }
    return mass_properties(space).volume < near * largest;
}

/// Adds a cell without faces to the parts if it is inside. Slivers that rounding makes are left out.
void decide(Polyhedron&& space, double near, const Triangles& triangles, ConvexSplit& split) {
    if (is_sliver(space, near)) return;
    const Vec3 centre = mean_of(space.vertices);
    const int turns = winding(triangles, centre);
    if (turns != 0 && turns != 1) split.crossed_at = centre;
    if (turns > 0) split.parts.push_back(std::move(space));
}

/// Cuts a cell; where vertices at the edge of the band make that impossible, with another band.
Cut cut_cell(const Polyhedron& space, const Plane& plane, double near) {
    Cut halves;
    for (const double factor : {1.0, 0.0, 3.0, 10.0, 30.0}) {
        halves = cut_with_band(space, plane, factor * near);
        if (halves.outcome != CutOutcome::sliver) break;
    }
    return halves;
}

/// The volume of the whole solid on the side of the plane to which its normal points: by the divergence theorem from a point of the plane, from
/// which the cut itself adds nothing.
double volume_in_front(const Triangles& triangles, const Plane& plane) {
    double six_volumes = 0;
    for (const auto& t : triangles) {
        const std::vector<Vec3> part = clip({t[0], t[1], t[2]}, plane, 1);
        for (std::size_t i = 2; i < part.size(); ++i)
            six_volumes += (part[0] - plane.origin).dot((part[i - 1] - plane.origin).cross(part[i] - plane.origin));
    }
    return six_volumes / 6;
}

/// Of the planes that split the fewest faces the one that divides the solid most evenly, which leaves no thin pieces at the foot of a slope; the
/// first of equals.
Plane best_plane(const std::vector<Fragment>& fragments, double near, const Triangles& triangles, double volume) {
    const std::vector<Plane> planes = best_planes(fragments, near);
    if (planes.size() == 1) return planes.front();
    constexpr double clearly = 1e-6; // of the volume
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double front = volume_in_front(triangles, planes[i]), smaller = std::min(front, volume - front);
        if (smaller < clearly * volume) return planes[i]; // of the hull: those that remain at last are of the hollows
        if (smaller > most + clearly * volume) best = i, most = smaller;
    }
    return planes[best];
}

ConvexSplit split_space(Cell&& whole, double near, const Triangles& triangles) {
    ConvexSplit split;
    const double volume = volume_of(triangles);
    std::vector<Cell> waiting;
    waiting.push_back(std::move(whole));
    const auto pass_on = [&](Polyhedron&& space, std::vector<Fragment>&& fragments) {
        if (fragments.empty()) decide(std::move(space), near, triangles, split);
        else waiting.push_back({std::move(space), std::move(fragments)});
    };
    while (!waiting.empty() && !split.crossed_at) {
        Cell cell = std::move(waiting.back());
        waiting.pop_back();
        const Plane plane = best_plane(cell.fragments, near, triangles, volume);
        Sides sides = sort_sides(cell.fragments, plane, near);
        Cut halves = cut_cell(cell.space, plane, near);
        if (halves.outcome == CutOutcome::cut) {
            pass_on(std::move(halves.below), std::move(sides.back));
            pass_on(std::move(halves.above), std::move(sides.front));
        } else if (halves.outcome == CutOutcome::above) {
            pass_on(std::move(cell.space), std::move(sides.front));
        } else if (halves.outcome == CutOutcome::below) {
            pass_on(std::move(cell.space), std::move(sides.back));
        } else { // the plane grazes the space
            sides.front.insert(sides.front.end(), sides.back.begin(), sides.back.end());
            pass_on(std::move(cell.space), std::move(sides.front));
        }
    }
    return split;
}

std::vector<Fragment> fragments_of(const Surface& surface) {
    std::vector<Fragment> fragments;
    std::size_t number = 0;
    for (const auto& face : surface.faces) {
        const Plane plane{mean_normal(surface, face), mean_point(surface, face)};
        for (const auto& t : triangles_of(surface.vertices, face))
            fragments.push_back(
                {{surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]}, plane, number});
        ++number;
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

ConvexSplit convex_parts(const Surface& surface) {
    constexpr std::size_t most_faces = 5000;
    if (surface.faces.size() > most_faces)
        throw Diagnostic(
            fmt::format("the concave surface has {} faces, too many to split into convex parts", surface.faces.size()),
            fmt::format("simplify it to at most {} faces: `import ... simplify n`", most_faces));
    const double size = size_of(surface.vertices), near = 1e-8 * size;
    const auto [low, high] = box_around(surface.vertices);
    const Vec3 margin = Vec3::Constant(0.1 * size);
    const Triangles triangles = triangles_of(surface);
    ConvexSplit split = split_space({make_brick(low - margin, high + margin), fragments_of(surface)}, near, triangles);
    if (split.crossed_at) return split;

    double volume = 0;
    for (Polyhedron& part : split.parts) {
        snap(part, surface.vertices, 10 * near);
        volume += mass_properties(part).volume;
    }
    const double wanted = volume_of(triangles);
    if (split.parts.empty() || std::abs(volume - wanted) > 1e-6 * wanted)
        throw Diagnostic(fmt::format("the concave surface could not be split into convex parts: they have {:.6g} "
                                     "of its volume {:.6g}",
                                     volume, wanted),
                         "give it as convex blocks and join them");
    restore_joint_sets(split.parts, surface, 10 * near);
    return split;
}

} // namespace kaya
