// Faces that should be flat: merging coplanar pieces, removing small warp, splitting large.
#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "base/number_text.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

namespace kaya {
namespace {

using HalfEdge = std::pair<int, int>;

/// The face to the left of each half-edge.
std::map<HalfEdge, int> half_edges_of(const Surface& surface) {
    std::map<HalfEdge, int> result;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const auto& loop = surface.faces[f].vertices;
        for (std::size_t i = 0; i < loop.size(); ++i)
            result[{loop[i], loop[(i + 1) % loop.size()]}] = static_cast<int>(f);
    }
    return result;
}

/// Faces connected to `seed` in its plane that are not in a group yet.
std::vector<int> plane_mates(const Surface& surface, const std::map<HalfEdge, int>& half_edges, int seed,
                             const std::vector<bool>& grouped, double near) {
    const Vec3 normal = mean_normal(surface, surface.faces[seed]);
    const Vec3 centre = mean_point(surface, surface.faces[seed]);
    const auto fits = [&](int f) {
        const auto& face = surface.faces[f];
        if (face.joint_set != surface.faces[seed].joint_set) return false;
        if (mean_normal(surface, face).dot(normal) < 0.9) return false;
        return std::all_of(face.vertices.begin(), face.vertices.end(),
                           [&](int v) { return std::abs(normal.dot(surface.vertices[v] - centre)) <= near; });
    };
    std::vector<int> group{seed};
    std::set<int> members{seed};
    StopPoints stops;
    for (std::size_t next = 0; next < group.size(); ++next) {
        stops.pass();
        const auto& loop = surface.faces[group[next]].vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int other = half_edges.at({loop[(i + 1) % loop.size()], loop[i]});
            if (grouped[other] || members.contains(other) || !fits(other)) continue;
            group.push_back(other);
            members.insert(other);
        }
    }
    std::sort(group.begin(), group.end());
    return group;
}

/// The outline of a group of faces; empty when it is not one simple loop.
std::vector<int> outline_of(const Surface& surface, const std::vector<int>& group) {
    std::map<int, int> next;
    std::map<HalfEdge, int> inside;
    for (const int f : group) {
        const auto& loop = surface.faces[f].vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) inside[{loop[i], loop[(i + 1) % loop.size()]}] = f;
    }
    for (const auto& [edge, f] : inside) {
        if (inside.contains({edge.second, edge.first})) continue;
        if (!next.emplace(edge.first, edge.second).second) return {};
    }
    std::vector<int> loop{surface.faces[group.front()].vertices.front()};
    if (!next.contains(loop.front())) loop.front() = next.begin()->first;
    for (int v = next.at(loop.front()); v != loop.front(); v = next.at(v)) loop.push_back(v);
    if (loop.size() != next.size()) loop.clear();
    return loop;
}

/// Leaves out vertices between two faces only, where their common edge runs straight on.
void drop_mid_edge_corners(Surface& surface, double near) {
    std::vector<int> faces_at(surface.vertices.size(), 0);
    for (const auto& face : surface.faces)
        for (const int v : face.vertices) ++faces_at[v];
    std::vector<bool> straight(surface.vertices.size(), false);
    for (const auto& face : surface.faces) {
        const std::size_t count = face.vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const int v = face.vertices[i];
            if (faces_at[v] != 2) continue;
            const Vec3& before = surface.vertices[face.vertices[(i + count - 1) % count]];
            const Vec3 chord = surface.vertices[face.vertices[(i + 1) % count]] - before;
            const Vec3 arm = surface.vertices[v] - before;
            straight[v] = chord.dot(arm) > 0 && chord.cross(arm).norm() <= near * chord.norm();
        }
    }
    for (auto& face : surface.faces) {
        std::vector<int> left;
        for (const int v : face.vertices)
            if (!straight[v]) left.push_back(v);
        if (left.size() > 2) face.vertices = std::move(left);
    }
}

/// Triangles instead of a face. The diagonal of a four-cornered face starts at its lowest corner, so that
/// a neighbour with the same four corners gets the same one.
std::vector<Surface::Face> split(const Surface& surface, const Surface::Face& face, const Diagonals& diagonals) {
    const auto other = diagonals.find(face.name);
    const std::size_t turn = other == diagonals.end() ? 0 : static_cast<std::size_t>(other->second);
    Surface::Face given = face;
    std::vector<int>& loop = given.vertices;
    std::vector<std::array<int, 3>> triangles;
    if (loop.size() == 4) {
        const auto lowest = std::min_element(loop.begin(), loop.end(), [&](int a, int b) {
            return std::lexicographical_compare(surface.vertices[a].begin(), surface.vertices[a].end(),
                                                surface.vertices[b].begin(), surface.vertices[b].end());
        });
        std::rotate(loop.begin(), lowest, loop.end());
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(turn % loop.size()), loop.end());
    if (loop.size() == 4) triangles = {{loop[0], loop[1], loop[2]}, {loop[0], loop[2], loop[3]}};
    else triangles = triangles_of(surface.vertices, given);
    std::vector<Surface::Face> result;
    for (const auto& t : triangles) result.push_back({{t[0], t[1], t[2]}, face.joint_set, face.name});
    return result;
}

/// Puts triangles in place of the faces that are not flat.
void split_warped(Surface& surface, double rounding, const Diagonals& diagonals,
                  std::vector<std::string>& triangulated) {
    std::vector<Surface::Face> faces;
    for (auto& face : surface.faces) {
        if (warp(surface, face) <= rounding) {
            faces.push_back(std::move(face));
            continue;
        }
        triangulated.push_back(face.name);
        for (auto& triangle : split(surface, face, diagonals)) faces.push_back(std::move(triangle));
    }
    surface.faces = std::move(faces);
}

double worst_warp(const Surface& surface) {
    double worst = 0;
    for (const auto& face : surface.faces) worst = std::max(worst, warp(surface, face));
    return worst;
}

/// One sweep: moves every vertex to the mean of its projections on the planes of its faces.
void pull_to_planes(Surface& surface) {
    std::vector<Vec3> move(surface.vertices.size(), Vec3::Zero());
    std::vector<int> count(surface.vertices.size(), 0);
    for (const auto& face : surface.faces) {
        if (face.vertices.size() < 4) continue;
        const Vec3 normal = mean_normal(surface, face), centre = mean_point(surface, face);
        for (const int v : face.vertices) {
            move[v] -= normal.dot(surface.vertices[v] - centre) * normal;
            ++count[v];
        }
    }
    for (std::size_t v = 0; v < move.size(); ++v)
        if (count[v]) surface.vertices[v] += move[v] / count[v];
}

/// Advice for a face that is not flat. Two triangles with the diagonal that stands out keep a block convex.
std::string advice_for(const Surface& surface, const Surface::Face& face) {
    if (face.vertices.size() != 4) return "correct the corners, or give triangles instead";
    const auto corner = [&](std::size_t i) -> const Vec3& { return surface.vertices[face.vertices[i]]; };
    Vec3 inside = Vec3::Zero();
    for (const Vec3& v : surface.vertices) inside += v / static_cast<double>(surface.vertices.size());
    Vec3 outward = (corner(2) - corner(0)).cross(corner(3) - corner(1));
    if (outward.dot(mean_point(surface, face) - inside) < 0) outward = -outward;
    const bool first = outward.dot(corner(0) + corner(2)) >= outward.dot(corner(1) + corner(3));
    const Vec3 &from = corner(first ? 0 : 1), &to = corner(first ? 2 : 3);
    return fmt::format("correct the corners, or give two triangles, cut from {} to {}", place_text(from),
                       place_text(to));
}

} // namespace

void merge_flat_neighbours(Surface& surface, const Flatness& flatness) {
    const double near = flatness.merged * size_of(surface.vertices);
    const auto half_edges = half_edges_of(surface);
    std::vector<bool> grouped(surface.faces.size(), false);
    std::vector<Surface::Face> merged;
    StopPoints stops;
    for (std::size_t seed = 0; seed < surface.faces.size(); ++seed) {
        stops.pass();
        if (grouped[seed]) continue;
        const std::vector<int> group = plane_mates(surface, half_edges, static_cast<int>(seed), grouped, near);
        std::vector<int> outline;
        if (group.size() > 1) outline = outline_of(surface, group);
        if (outline.empty()) {
            grouped[seed] = true;
            merged.push_back(surface.faces[seed]);
            continue;
        }
        for (const int f : group) grouped[f] = true;
        merged.push_back({std::move(outline), surface.faces[seed].joint_set, surface.faces[seed].name});
    }
    if (merged.size() == surface.faces.size() || merged.size() < 4) return;
    surface.faces = std::move(merged);
    drop_mid_edge_corners(surface, near);
    check_faces(surface);
}

double flatten(Surface& surface, const Flatness& flatness, const Diagonals& diagonals,
               std::vector<std::string>& triangulated) {
    const double size = size_of(surface.vertices);
    double reach = size;
    for (const Vec3& v : surface.vertices) reach = std::max(reach, v.lpNorm<1>());
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * reach;

    std::vector<Surface::Face> faces;
    for (const auto& face : surface.faces) {
        const double off = warp(surface, face);
        if (off <= std::max(flatness.mended * size, rounding)) {
            faces.push_back(face);
        } else if (flatness.triangulate_rest || off <= flatness.triangulated * size) {
            triangulated.push_back(face.name);
            for (auto& triangle : split(surface, face, diagonals)) faces.push_back(std::move(triangle));
        } else {
            throw Diagnostic(
                fmt::format("{} is not flat: its corners lie up to {:.3g} off its mean plane", face.name, off),
                advice_for(surface, face));
        }
    }
    surface.faces = std::move(faces);

    const std::vector<Vec3> before = surface.vertices;
    // A chain of few faces, each dependent on the next, may need many sweeps; in a fine net the number is too large.
    constexpr int most_sweeps = 20000, sweeps_of_net = 200;
    const bool triangles_allowed = flatness.triangulate_rest || flatness.triangulated > 0;
    const int patience = flatness.triangulate_rest && surface.faces.size() > fine_net ? sweeps_of_net : most_sweeps;
    int sweep = 0;
    while (worst_warp(surface) > rounding) {
        if (++sweep > patience && triangles_allowed) {
            split_warped(surface, rounding, diagonals, triangulated);
            break;
        }
        if (sweep > most_sweeps) {
            const auto worst =
                std::max_element(surface.faces.begin(), surface.faces.end(),
                                 [&](const auto& a, const auto& b) { return warp(surface, a) < warp(surface, b); });
            throw Diagnostic(fmt::format("{} cannot be made flat together with its neighbours", worst->name),
                             "correct the corners, or give triangles instead");
        }
        pull_to_planes(surface);
    }
    double longest = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
        longest = std::max(longest, (surface.vertices[v] - before[v]).norm());
    return longest;
}

} // namespace kaya
