#include "geometry/surface/surface.hpp"

#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "base/number_text.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "geometry/surface/surface_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <numeric>

namespace kaya {
namespace {

/// Representative of a set that may have been joined to others.
int root_of(std::vector<int>& parent, int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

using Edge = std::array<int, 2>;

/// One side of an edge: the face, and whether it runs from the lower to the higher vertex.
struct EdgeUse {
    int face = 0;
    bool rising = false;
};

std::map<Edge, std::vector<EdgeUse>> edges_of(const Surface& surface) {
    std::map<Edge, std::vector<EdgeUse>> edges;
    StopPoints stops;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        stops.pass();
        const auto& loop = surface.faces[f].vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int a = loop[i], b = loop[(i + 1) % loop.size()];
            edges[{std::min(a, b), std::max(a, b)}].push_back({static_cast<int>(f), a < b});
        }
    }
    return edges;
}

/// Direction from an edge into a face on it.
Vec3 into_face(const Surface& surface, const Edge& edge, const EdgeUse& use) {
    const Vec3 along = (surface.vertices[edge[1]] - surface.vertices[edge[0]]).normalized();
    return mean_normal(surface, surface.faces[use.face]).cross(use.rising ? along : Vec3(-along));
}

/// The faces of an edge of four or more that continue each other: those that lie on each other, and two that are left then.
std::vector<std::array<int, 2>> pairs_on(const Surface& surface, const Edge& edge, std::vector<EdgeUse> uses) {
    constexpr double same_direction = 1e-3;
    std::vector<std::array<int, 2>> pairs;
    for (std::size_t i = 0; i < uses.size();) {
        const Vec3 direction = into_face(surface, edge, uses[i]);
        const auto own = uses.begin() + static_cast<std::ptrdiff_t>(i);
        const auto partner = std::find_if(own + 1, uses.end(), [&](const EdgeUse& other) {
            return (into_face(surface, edge, other) - direction).norm() < same_direction;
        });
        if (partner == uses.end()) {
            ++i;
            continue;
        }
        pairs.push_back({own->face, partner->face});
        uses.erase(partner);
        uses.erase(uses.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (uses.size() == 2) pairs.push_back({uses[0].face, uses[1].face});
    return pairs;
}

/// Number of the edge-connected part that each face belongs to, counted from 0 by first face. Closed parts may meet in an edge.
std::vector<int> parts_of(const Surface& surface) {
    std::vector<int> parent(surface.faces.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto join = [&](int one, int other) {
        const int a = root_of(parent, one), b = root_of(parent, other);
        parent[std::max(a, b)] = std::min(a, b);
    };
    const auto edges = edges_of(surface);
    // An odd number of faces at an edge is a mistake of all of them.
    for (const auto& [edge, uses] : edges)
        if (uses.size() == 2 || uses.size() % 2 != 0)
            for (const EdgeUse& use : uses) join(uses.front().face, use.face);
    for (const auto& [edge, uses] : edges) {
        if (uses.size() == 2 || uses.size() % 2 != 0) continue;
        std::map<int, int> uses_by_part;
        for (const EdgeUse& use : uses) ++uses_by_part[root_of(parent, use.face)];
        if (std::ranges::all_of(uses_by_part, [](const auto& part) { return part.second % 2 == 0; })) continue;
        for (const auto& [one, other] : pairs_on(surface, edge, uses)) join(one, other);
    }
    std::vector<int> part(parent.size());
    int count = 0;
    for (std::size_t f = 0; f < parent.size(); ++f) {
        const int root = root_of(parent, static_cast<int>(f));
        part[f] = root == static_cast<int>(f) ? count++ : part[root];
    }
    return part;
}

void drop_unused_vertices(Surface& surface) {
    std::vector<int> number(surface.vertices.size(), -1);
    for (const auto& face : surface.faces)
        for (const int v : face.vertices) number[v] = 0;
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] < 0) continue;
        number[i] = static_cast<int>(kept.size());
        kept.push_back(surface.vertices[i]);
    }
    for (auto& face : surface.faces)
        for (int& v : face.vertices) v = number[v];
    surface.vertices = std::move(kept);
}

double volume_of(const Surface& surface) {
    double volume = 0;
    const Vec3 base = surface.vertices.front();
    for (const auto& face : surface.faces) {
        const Vec3 a = surface.vertices[face.vertices[0]] - base;
        for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i)
            volume +=
                a.dot(
                    (surface.vertices[face.vertices[i]] - base).cross(surface.vertices[face.vertices[i + 1]] - base)) /
                6;
    }
    return volume;
}

/// Gives all faces of a connected surface the orientation of the first one; returns how many were turned.
int turn_connected_alike(Surface& surface, const std::map<Edge, std::vector<EdgeUse>>& edges) {
    const std::vector<int> part = parts_of(surface);
    const auto stray = std::find_if(part.begin(), part.end(), [](int p) { return p > 0; });
    if (stray != part.end())
        throw Diagnostic(fmt::format("the faces fall apart in {} closed surfaces; {} belongs to the second",
                                     *std::max_element(part.begin(), part.end()) + 1,
                                     surface.faces[stray - part.begin()].name),
                         "make a block of each");

    std::vector<std::vector<std::pair<int, bool>>> neighbours(surface.faces.size());
    for (const auto& [edge, uses] : edges) {
        if (uses.size() != 2) continue;
        const bool opposed = uses[0].rising != uses[1].rising;
        neighbours[uses[0].face].emplace_back(uses[1].face, opposed);
        neighbours[uses[1].face].emplace_back(uses[0].face, opposed);
    }
    enum { unknown, kept, turned };
    std::vector<int> state(surface.faces.size(), unknown);
    std::vector<int> front{0};
    state[0] = kept;
    while (!front.empty()) {
        const int face = front.back();
        front.pop_back();
        for (const auto& [other, opposed] : neighbours[face]) {
            const int wanted = opposed ? state[face] : (state[face] == kept ? turned : kept);
            if (state[other] == unknown) {
                state[other] = wanted;
                front.push_back(other);
            } else if (state[other] != wanted) {
                throw Diagnostic(fmt::format("the surface has no inside: {} and {} cannot both face outward",
                                             surface.faces[face].name, surface.faces[other].name));
            }
        }
    }
    int count = 0;
    for (std::size_t f = 0; f < state.size(); ++f) {
        if (state[f] != turned) continue;
        std::reverse(surface.faces[f].vertices.begin() + 1, surface.faces[f].vertices.end());
        ++count;
    }
    return count;
}

} // namespace

double size_of(const std::vector<Vec3>& vertices) {
    if (vertices.empty()) return 0;
    const auto [low, high] = box_around(vertices);
    return (high - low).norm();
}

Vec3 mean_point(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {
    Vec3 sum = Vec3::Zero();
    for (const int v : loop) sum += vertices[v];
    return sum / static_cast<double>(loop.size());
}

Vec3 mean_normal(const std::vector<Vec3>& vertices, const std::vector<int>& loop) {
    const Vec3 centre = mean_point(vertices, loop);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (vertices[loop[i]] - centre).cross(vertices[loop[(i + 1) % loop.size()]] - centre);
    const double length = sum.norm();
    return length > 0 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

double warp(const Surface& surface, const Surface::Face& face) {
    if (face.vertices.size() < 4) return 0;
    const Vec3 centre = mean_point(surface, face), normal = mean_normal(surface, face);
    double worst = 0;
    for (const int v : face.vertices) worst = std::max(worst, std::abs(normal.dot(surface.vertices[v] - centre)));
    return worst;
}

Surface surface_from_loops(const std::vector<std::vector<Vec3>>& loops, double near) {
    std::vector<Vec3> corners;
    for (const auto& loop : loops) corners.insert(corners.end(), loop.begin(), loop.end());
    // Corners are sorted into cells as wide as `near`: points within that distance lie in one of 27 cells.
    using Cell = std::array<std::int64_t, 3>;
    const auto cell_of = [&](const Vec3& v) {
        Cell cell{};
        for (int k = 0; k < 3; ++k) {
            const double place = std::floor(v[k] / (near > 0 ? near : 1));
            if (std::abs(place) < 1e18) cell[k] = static_cast<std::int64_t>(place);
        }
        return cell;
    };
    std::map<Cell, std::vector<int>> cells;
    std::vector<int> parent(corners.size());
    std::iota(parent.begin(), parent.end(), 0);
    StopPoints stops;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        stops.pass();
        const Cell home = cell_of(corners[i]);
        for (int offset = 0; offset < 27; ++offset) {
            const auto found =
                cells.find({home[0] + offset % 3 - 1, home[1] + offset / 3 % 3 - 1, home[2] + offset / 9 - 1});
            if (found == cells.end()) continue;
            for (const int other : found->second) {
                stops.pass();
                if ((corners[other] - corners[i]).norm() > near) continue;
                const int a = root_of(parent, static_cast<int>(i)), b = root_of(parent, other);
                parent[std::max(a, b)] = std::min(a, b);
            }
        }
        // A corner that has joined another is found through that one.
        if (parent[i] == static_cast<int>(i)) cells[home].push_back(static_cast<int>(i));
    }
    Surface surface;
    std::vector<int> number(corners.size(), -1);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const int root = root_of(parent, static_cast<int>(i));
        if (number[root] < 0) {
            number[root] = static_cast<int>(surface.vertices.size());
            surface.vertices.push_back(corners[root]);
        }
        number[i] = number[root];
    }
    int corner = 0;
    for (const auto& loop : loops) {
        Surface::Face face;
        face.name = fmt::format("face {}", surface.faces.size() + 1);
        for (std::size_t i = 0; i < loop.size(); ++i) face.vertices.push_back(number[corner++]);
        surface.faces.push_back(std::move(face));
    }
    return surface;
}

std::vector<Surface> separate(const Surface& surface) {
    const std::vector<int> part = parts_of(surface);
    std::vector<Surface> result;
    for (std::size_t f = 0; f < part.size(); ++f) {
        if (part[f] == static_cast<int>(result.size())) {
            stop_point(); // each part gets all corners for a moment
            result.push_back({surface.vertices, {}});
        }
        result[part[f]].faces.push_back(surface.faces[f]);
    }
    for (Surface& one : result) {
        stop_point();
        drop_unused_vertices(one);
    }
    return result;
}

void check_faces(Surface& surface) {
    for (const Vec3& v : surface.vertices)
        if (!v.allFinite()) throw Diagnostic("a corner has a coordinate that is not a finite number");
    const double size = size_of(surface.vertices);
    std::map<std::vector<int>, const Surface::Face*> known;
    for (auto& face : surface.faces) {
        auto& loop = face.vertices;
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        if (loop.size() < 3)
            throw Diagnostic(
                fmt::format("{} has only {} different corner{}", face.name, loop.size(), loop.size() == 1 ? "" : "s"),
                "a face needs at least three");
        std::vector<int> sorted = loop;
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice != sorted.end())
            throw Diagnostic(fmt::format("{} passes twice through {}", face.name, place_text(surface.vertices[*twice])),
                             "give its corners once each, in order around the face");
        const auto [other, fresh] = known.emplace(std::move(sorted), &face);
        if (!fresh)
            throw Diagnostic(fmt::format("{} has the same corners as {}", face.name, other->second->name),
                             "give every face once");
        double widest = 0;
        const Vec3 centre = mean_point(surface, face);
        for (std::size_t i = 0; i < loop.size(); ++i)
            widest = std::max(widest, (surface.vertices[loop[i]] - centre)
                                          .cross(surface.vertices[loop[(i + 1) % loop.size()]] - centre)
                                          .norm());
        if (widest <= 1e-12 * size * size)
            throw Diagnostic(fmt::format("{} has no area: its corners lie on one line", face.name),
                             "give three corners that span a plane");
    }
    if (surface.faces.size() < 4)
        throw Diagnostic(fmt::format("{} faces do not close a polyhedron", surface.faces.size()),
                         "it takes at least four");
    drop_unused_vertices(surface);
}

bool is_closed(const Surface& surface) {
    return std::ranges::all_of(edges_of(surface), [](const auto& edge) { return edge.second.size() % 2 == 0; });
}

int turn_alike(Surface& surface) {
    const auto edges = edges_of(surface);
    for (const auto& [edge, uses] : edges) {
        if (uses.size() % 2 == 0) continue;
        const std::string where = fmt::format("the edge from {} to {}", place_text(surface.vertices[edge[0]]),
                                              place_text(surface.vertices[edge[1]]));
        const std::string& name = surface.faces[uses[0].face].name;
        if (uses.size() == 1)
            throw Diagnostic(fmt::format("the surface is open: {} belongs to {} alone", where, name),
                             "add the face that is missing, or give the corner exactly as in the other face");
        throw Diagnostic(fmt::format("{} faces meet in {}, among them {} and {}", uses.size(), where, name,
                                     surface.faces[uses[1].face].name),
                         "an even number of faces meets in an edge of a closed surface, two as a rule");
    }
    return turn_connected_alike(surface, edges);
}

std::vector<std::array<Vec3, 2>> turn_open_alike(Surface& surface) {
    const auto edges = edges_of(surface);
    std::vector<std::array<Vec3, 2>> rim;
    for (const auto& [edge, uses] : edges) {
        const Vec3 &from = surface.vertices[edge[0]], &to = surface.vertices[edge[1]];
        if (uses.size() > 2)
            throw Diagnostic(fmt::format("{} faces of the open surface meet in the edge from {} to {}", uses.size(),
                                         place_text(from), place_text(to)),
                             "two faces meet in an edge; put each branch into a separate file");
        if (uses.size() == 1) rim.push_back({from, to});
    }
    turn_connected_alike(surface, edges);
    return rim;
}

bool turn_outward(Surface& surface) {
    const double volume = volume_of(surface), size = size_of(surface.vertices);
    if (std::abs(volume) <= 1e-15 * size * size * size)
        throw Diagnostic("the surface encloses no volume", "its faces lie in one plane or on each other");
    if (volume > 0) return false;
    for (auto& face : surface.faces) std::reverse(face.vertices.begin() + 1, face.vertices.end());
    return true;
}

bool is_convex(const Surface& surface, double tolerance) {
    // A closed surface of one piece is convex when it is so at every edge and every vertex (Tietze and Nakajima 1928).
    std::vector<double> angle(surface.vertices.size(), 0);
    for (const auto& face : surface.faces) {
        const Vec3 normal = mean_normal(surface, face);
        const std::size_t count = face.vertices.size();
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3& a = surface.vertices[face.vertices[i]];
            const Vec3 along = (surface.vertices[face.vertices[(i + 1) % count]] - a).normalized();
            const Vec3 back = (surface.vertices[face.vertices[(i + count - 1) % count]] - a).normalized();
            const Vec3 inward = normal.cross(along);
            for (const int v : face.vertices)
                if (inward.dot(surface.vertices[v] - a) < -tolerance) return false;
            angle[face.vertices[i]] += std::atan2(along.cross(back).norm(), along.dot(back));
        }
    }
    if (std::any_of(angle.begin(), angle.end(), [](double sum) { return sum > 2 * std::numbers::pi + 1e-6; }))
        return false;
    for (const auto& [edge, uses] : edges_of(surface)) {
        for (const EdgeUse& use : uses) {
            const auto& face = surface.faces[use.face];
            const Vec3 normal = mean_normal(surface, face), centre = mean_point(surface, face);
            for (const EdgeUse& other : uses)
                for (const int v : surface.faces[other.face].vertices)
                    if (normal.dot(surface.vertices[v] - centre) > tolerance) return false;
        }
    }
    return true;
}

} // namespace kaya
