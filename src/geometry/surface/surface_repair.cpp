#include "geometry/surface/surface_repair.hpp"

#include "base/stop_point.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace kaya {
namespace {

using Edge = std::array<int, 2>;

Edge edge_between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

template <class Visit> void each_edge(const Surface::Face& face, Visit visit) {
    for (std::size_t i = 0; i < face.vertices.size(); ++i)
        visit(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]);
}

std::map<Edge, int> uses_of_edges(const Surface& surface) {
    std::map<Edge, int> uses;
    StopPoints stops;
    for (const auto& face : surface.faces) {
        stops.pass();
        each_edge(face, [&](int a, int b) { ++uses[edge_between(a, b)]; });
    }
    return uses;
}

/// Edges of an odd number of faces: borders of holes and cracks.
std::set<Edge> open_edges(const Surface& surface) {
    std::set<Edge> open;
    for (const auto& [edge, count] : uses_of_edges(surface))
        if (count % 2 != 0) open.insert(edge);
    return open;
}

/// Cuts loops that pass twice through a corner in two, and drops those that shrink to a line.
void simplify_loops(Surface& surface) {
    std::vector<Surface::Face> waiting = std::move(surface.faces), faces;
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
        Surface::Face face = std::move(waiting.back());
        waiting.pop_back();
        auto& loop = face.vertices;
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        std::map<int, std::size_t> seen;
        bool cut = false;
        for (std::size_t i = 0; i < loop.size() && !cut; ++i) {
            const auto [first, fresh] = seen.emplace(loop[i], i);
            if (fresh) continue;
            Surface::Face inner = face;
            inner.vertices.assign(loop.begin() + static_cast<std::ptrdiff_t>(first->second),
                                  loop.begin() + static_cast<std::ptrdiff_t>(i));
            loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(first->second),
                       loop.begin() + static_cast<std::ptrdiff_t>(i));
            waiting.push_back(std::move(face));
            waiting.push_back(std::move(inner));
            cut = true;
        }
        if (!cut && loop.size() > 2) faces.push_back(std::move(face));
    }
    surface.faces = std::move(faces);
}

/// Twice the area over the longest distance of two corners.
double width(const Surface& surface, const Surface::Face& face) {
    Vec3 twice_area = Vec3::Zero();
    double longest = 0;
    const Vec3& base = surface.vertices[face.vertices.front()];
    each_edge(face, [&](int a, int b) {
        twice_area += (surface.vertices[a] - base).cross(surface.vertices[b] - base);
        longest = std::max(
            {longest, (surface.vertices[b] - surface.vertices[a]).norm(), (surface.vertices[a] - base).norm()});
    });
    return longest > 0 ? twice_area.norm() / longest : 0;
}

void drop_narrow_faces(Surface& surface, double near, RepairCounts& counts) {
    counts.narrow += static_cast<int>(
        std::erase_if(surface.faces, [&](const Surface::Face& face) { return width(surface, face) <= near; }));
}

/// Corners of open edges that lie on the open edge from `a` to `b`, in order.
std::vector<int> corners_on(const Surface& surface, const std::set<int>& corners, int a, int b, double near) {
    const Vec3 &from = surface.vertices[a], along = surface.vertices[b] - from;
    const double length = along.norm();
    std::vector<std::pair<double, int>> found;
    for (const int corner : corners) {
        if (corner == a || corner == b) continue;
        const Vec3 arm = surface.vertices[corner] - from;
        const double reach = arm.dot(along) / length;
        if (reach > 0 && reach < length && (arm - reach / length * along).norm() <= near)
            found.emplace_back(reach, corner);
    }
    std::sort(found.begin(), found.end());
    std::vector<int> result;
    for (const auto& [reach, corner] : found) result.push_back(corner);
    return result;
}

/// Puts corners that lie on open edges into the faces of those edges.
void insert_corners(Surface& surface, double near, RepairCounts& counts) {
    const std::set<Edge> open = open_edges(surface);
    std::set<int> corners;
    for (const Edge& edge : open) corners.insert(edge.begin(), edge.end());
    std::map<Edge, std::vector<int>> added;
    StopPoints stops;
    for (const Edge& edge : open) {
        stops.pass();
        if (auto found = corners_on(surface, corners, edge[0], edge[1], near); !found.empty())
            added.emplace(edge, std::move(found));
    }
    for (auto& face : surface.faces) {
        std::vector<int> loop;
        each_edge(face, [&](int a, int b) {
            loop.push_back(a);
            const auto found = added.find(edge_between(a, b));
            if (found == added.end()) return;
            counts.inserted += static_cast<int>(found->second.size());
            if (a < b) loop.insert(loop.end(), found->second.begin(), found->second.end());
            else loop.insert(loop.end(), found->second.rbegin(), found->second.rend());
        });
        face.vertices = std::move(loop);
    }
    simplify_loops(surface);
}

/// Faces over the holes whose borders are simple loops no wider than `hole`.
void close_holes(Surface& surface, double hole, RepairCounts& counts) {
    std::map<int, std::vector<int>> next;
    for (const Edge& edge : open_edges(surface)) {
        next[edge[0]].push_back(edge[1]);
        next[edge[1]].push_back(edge[0]);
    }
    std::set<int> done;
    for (const auto& [start, neighbours] : next) {
        if (done.contains(start)) continue;
        std::vector<int> loop{start};
        int before = start, at = neighbours.front();
        bool simple = neighbours.size() == 2;
        while (simple && at != start) {
            const auto& around = next.at(at);
            simple = around.size() == 2 && !done.contains(at);
            loop.push_back(at);
            done.insert(at);
            const int after = around[0] == before ? around.back() : around[0];
            before = at;
            at = after;
        }
        done.insert(start);
        std::vector<Vec3> border;
        for (const int v : loop) border.push_back(surface.vertices[v]);
        if (!simple || loop.size() < 3 || size_of(border) > hole) continue;
        surface.faces.push_back({std::move(loop), 0, fmt::format("the face over hole {}", ++counts.closed)});
    }
}

} // namespace

void drop_doubled_faces(Surface& surface, RepairCounts& counts) {
    std::map<std::vector<int>, std::vector<std::size_t>> copies;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        std::vector<int> corners = surface.faces[f].vertices;
        std::sort(corners.begin(), corners.end());
        copies[std::move(corners)].push_back(f);
    }
    if (copies.size() == surface.faces.size()) return;
    const std::map<Edge, int> uses = uses_of_edges(surface);
    std::vector<bool> dropped(surface.faces.size(), false);
    for (const auto& [corners, faces] : copies) {
        if (faces.size() < 2) continue;
        // Faces of the edges without the copies: with an odd number of them one copy closes the edges. Edges of walls that meet count for
        // themselves, so the majority decides.
        const int count = static_cast<int>(faces.size());
        int odd = 0;
        each_edge(surface.faces[faces.front()],
                  [&](int a, int b) { odd += (uses.at(edge_between(a, b)) - count) % 2 != 0 ? 1 : -1; });
        for (std::size_t k = odd > 0 ? 1 : 0; k < faces.size(); ++k) dropped[faces[k]] = true;
    }
    std::vector<Surface::Face> kept;
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        if (!dropped[f]) kept.push_back(surface.faces[f]);
    if (kept.empty()) return; // nothing but walls: the message about it names them
    counts.doubled += static_cast<int>(surface.faces.size() - kept.size());
    surface.faces = std::move(kept);
}

void repair_surface(Surface& surface, const Repair& repair, RepairCounts& counts) {
    if (repair.near > 0) {
        simplify_loops(surface);
        drop_narrow_faces(surface, repair.near, counts);
        insert_corners(surface, repair.near, counts);
    }
    drop_doubled_faces(surface, counts);
    if (repair.hole > 0) close_holes(surface, repair.hole, counts);
}

} // namespace kaya
