// Hill climbing on the shape of the worst tetrahedron, with the moves of Freitag and Ollivier-Gooch 1997
// (Int. J. Numer. Meth. Engng 40) and the removal of edges by the best triangulation of the ring
// around them (Klincsek 1980; de l'Isle and George 1995).
#include "geometry/tet_improvement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaya {
namespace {

using Tet = std::array<int, 4>;

/// Tetrahedra below this are worked on; body-centred ones have 0.95.
constexpr double wanted_quality = 0.45;
constexpr double least_gain = 1e-6;
constexpr int most_rounds = 12;
constexpr std::size_t most_tries = 100;     ///< in all rounds, for each tetrahedron; a dozen is much
constexpr std::size_t tries_between = 1024; ///< two calls of a ProgressCallback
/// Rings of more points are left alone: their edge is seldom the cause of a bad shape.
constexpr std::size_t longest_ring = 9;

/// A mesh that can be changed: dead tetrahedra keep their place until the end.
class Changeable {
public:
    Changeable(MeshPoints& mesh_points, const std::vector<Tet>& given)
        : points(mesh_points), at_point(mesh_points.points.size()) {
        for (const Tet& t : given) add(t);
    }

    void add(const Tet& t) {
        for (const int v : t) at_point[v].push_back(static_cast<int>(tets.size()));
        tets.push_back(t);
        alive.push_back(true);
    }
    void remove(int number) {
        alive[number] = false;
        for (const int v : tets[number]) std::erase(at_point[v], number);
    }
    double quality(const Tet& t) const {
        const auto& p = points.points;
        return shape_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
    }
    double worst_at(int point) const {
        double worst = 1;
        for (const int t : at_point[point]) worst = std::min(worst, quality(tets[t]));
        return worst;
    }
    std::vector<int> around_edge(int a, int b) const {
        std::vector<int> result;
        for (const int t : at_point[a])
            if (std::find(tets[t].begin(), tets[t].end(), b) != tets[t].end()) result.push_back(t);
        return result;
    }

    MeshPoints& points;
    std::vector<Tet> tets;
    std::vector<bool> alive;
    std::vector<std::vector<int>> at_point;
};

/// The directions in which a point may move: all, in its face, or along its edge.
std::vector<Vec3> free_directions(const Polyhedron& polyhedron, const std::vector<int>& faces) {
    std::vector<Vec3> directions;
    if (faces.empty()) {
        for (int i = 0; i < 27; ++i)
            if (i != 13) directions.push_back(Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized());
    } else if (faces.size() == 1) {
        const Vec3 normal = face_normal(polyhedron, polyhedron.faces[faces[0]]);
        const Vec3 across = normal.unitOrthogonal(), up = normal.cross(across);
        for (int i = 0; i < 12; ++i) {
            const double angle = i * std::numbers::pi / 6;
            directions.push_back(std::cos(angle) * across + std::sin(angle) * up);
        }
    } else if (faces.size() == 2) {
        const Vec3 along = face_normal(polyhedron, polyhedron.faces[faces[0]])
                               .cross(face_normal(polyhedron, polyhedron.faces[faces[1]]))
                               .normalized();
        directions = {along, -along};
    }
    return directions;
}

double mean_edge_at(const Changeable& mesh, int point) {
    double sum = 0;
    int count = 0;
    for (const int t : mesh.at_point[point])
        for (const int v : mesh.tets[t]) {
            if (v == point) continue;
            sum += (mesh.points.points[v] - mesh.points.points[point]).norm();
            ++count;
        }
    return count ? sum / count : 0;
}

/// Climbs to where the worst tetrahedron at the point is best.
bool move_point(const Polyhedron& polyhedron, Changeable& mesh, int point) {
    const std::vector<Vec3> directions = free_directions(polyhedron, mesh.points.faces[point]);
    if (directions.empty()) return false;
    double best = mesh.worst_at(point);
    const double start = best, reach = mean_edge_at(mesh, point);
    for (double step = 0.25 * reach; step > 0.01 * reach;) {
        const Vec3 here = mesh.points.points[point];
        Vec3 target = here;
        for (const Vec3& direction : directions) {
            mesh.points.points[point] = here + step * direction;
            const double worst = mesh.worst_at(point);
            if (worst <= best + least_gain) continue;
            best = worst;
            target = mesh.points.points[point];
        }
        mesh.points.points[point] = target;
        if (target == here) step /= 2;
    }
    return best > start;
}

/// The points around the edge from a to b, anticlockwise seen from b; closed when the edge is inside.
struct Ring {
    std::vector<int> points;
    bool closed = false;
};

Ring ring_around(const Changeable& mesh, int a, int b, const std::vector<int>& tets) {
    std::vector<std::array<int, 2>> steps;
    for (const int number : tets) {
        std::array<int, 2> other{};
        int found = 0;
        for (const int v : mesh.tets[number])
            if (v != a && v != b) other[found++] = v;
        const auto& p = mesh.points.points;
        const Vec3 axis = p[b] - p[a];
        if (axis.dot((p[other[0]] - p[a]).cross(p[other[1]] - p[a])) < 0) std::swap(other[0], other[1]);
        steps.push_back(other);
    }
    Ring ring;
    const auto step_from = [&](int v) {
        return std::find_if(steps.begin(), steps.end(), [v](const auto& s) { return s[0] == v; });
    };
    // An open ring begins where no step leads to.
    std::array<int, 2> first = steps.front();
    ring.closed = true;
    for (const auto& s : steps)
        if (std::none_of(steps.begin(), steps.end(), [&](const auto& t) { return t[1] == s[0]; })) {
            first = s;
            ring.closed = false;
        }
    ring.points.push_back(first[0]);
    for (int v = first[1]; v != first[0] && ring.points.size() <= steps.size();) {
        ring.points.push_back(v);
        const auto next = step_from(v);
        if (next == steps.end()) break;
        v = (*next)[1];
    }
    if (ring.points.size() != steps.size() + (ring.closed ? 0 : 1)) ring.points.clear();
    return ring;
}

/// The best way to fill a ring with triangles, each making one tetrahedron with a and one with b.
struct Filling {
    double quality = -1;
    std::vector<Tet> tets;
};

Filling best_filling(const Changeable& mesh, int a, int b, const std::vector<int>& ring) {
    const int count = static_cast<int>(ring.size());
    std::array<std::array<double, longest_ring + 1>, longest_ring + 1> best{};
    std::array<std::array<int, longest_ring + 1>, longest_ring + 1> middle{};
    for (auto& row : best) row.fill(1);
    for (int span = 2; span < count; ++span)
        for (int i = 0; i + span < count; ++i) {
            const int j = i + span;
            best[i][j] = -std::numeric_limits<double>::infinity();
            for (int k = i + 1; k < j; ++k) {
                const double quality = std::min({best[i][k], best[k][j], mesh.quality({ring[i], ring[k], ring[j], b}),
                                                 mesh.quality({ring[i], ring[j], ring[k], a})});
                if (quality <= best[i][j]) continue;
                best[i][j] = quality;
                middle[i][j] = k;
            }
        }
    Filling filling;
    filling.quality = best[0][count - 1];
    if (filling.quality <= 0) return filling;
    std::vector<std::array<int, 2>> spans{{0, count - 1}};
    while (!spans.empty()) {
        const auto [i, j] = spans.back();
        spans.pop_back();
        if (j - i < 2) continue;
        const int k = middle[i][j];
        filling.tets.push_back({ring[i], ring[k], ring[j], b});
        filling.tets.push_back({ring[i], ring[j], ring[k], a});
        spans.push_back({i, k});
        spans.push_back({k, j});
    }
    return filling;
}

double worst_of(const Changeable& mesh, const std::vector<int>& tets) {
    double worst = 1;
    for (const int t : tets) worst = std::min(worst, mesh.quality(mesh.tets[t]));
    return worst;
}

void exchange(Changeable& mesh, const std::vector<int>& old_tets, const std::vector<Tet>& new_tets) {
    for (const int t : old_tets) mesh.remove(t);
    for (const Tet& t : new_tets) mesh.add(t);
}

/// Takes the edge out of the mesh when the tetrahedra that fill the ring around it are better.
bool remove_edge(Changeable& mesh, int a, int b) {
    const std::vector<int> tets = mesh.around_edge(a, b);
    if (tets.size() < 2 || tets.size() >= longest_ring) return false;
    const Ring ring = ring_around(mesh, a, b, tets);
    if (ring.points.size() < 3) return false;
    // On the surface the two outer triangles are exchanged too, which needs them in one face.
    if (!ring.closed && common_faces(mesh.points, {a, b, ring.points.front(), ring.points.back()}).empty())
        return false;
    const Filling filling = best_filling(mesh, a, b, ring.points);
    if (filling.quality <= worst_of(mesh, tets) + least_gain) return false;
    exchange(mesh, tets, filling.tets);
    return true;
}

/// Three tetrahedra around a new edge instead of two with a common triangle.
bool insert_edge(Changeable& mesh, int number, int corner) {
    Tet t = mesh.tets[number];
    const int apex = t[corner];
    std::array<int, 3> side{};
    for (int i = 0, k = 0; i < 4; ++i)
        if (i != corner) side[k++] = t[i];
    int other = -1;
    for (const int candidate : mesh.around_edge(side[0], side[1])) {
        const Tet& c = mesh.tets[candidate];
        if (candidate != number && std::find(c.begin(), c.end(), side[2]) != c.end()) other = candidate;
    }
    if (other < 0) return false;
    int far = -1;
    for (const int v : mesh.tets[other])
        if (std::find(side.begin(), side.end(), v) == side.end()) far = v;
    if (mesh.quality({side[0], side[1], side[2], apex}) < 0) std::swap(side[1], side[2]);
    std::vector<Tet> fresh;
    double worst = 1;
    for (int i = 0; i < 3; ++i) {
        fresh.push_back({far, apex, side[i], side[(i + 1) % 3]});
        worst = std::min(worst, mesh.quality(fresh.back()));
    }
    if (worst <= worst_of(mesh, {number, other}) + least_gain) return false;
    exchange(mesh, {number, other}, fresh);
    return true;
}

/// Tries all exchanges that would take one tetrahedron out.
bool exchange_around(Changeable& mesh, int number) {
    const Tet t = mesh.tets[number];
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (remove_edge(mesh, t[i], t[j])) return true;
    for (int corner = 0; corner < 4; ++corner)
        if (insert_edge(mesh, number, corner)) return true;
    return false;
}

} // namespace

double shape_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 ab = b - a, ac = c - a, ad = d - a;
    const double six_volumes = ab.dot(ac.cross(ad));
    const double squares = ab.squaredNorm() + ac.squaredNorm() + ad.squaredNorm() + (c - b).squaredNorm() +
                           (d - b).squaredNorm() + (d - c).squaredNorm();
    if (squares == 0) return 0;
    const double mean_square = squares / 6;
    return std::numbers::sqrt2 * six_volumes / (mean_square * std::sqrt(mean_square));
}

void improve(const Polyhedron& polyhedron, MeshPoints& points, std::vector<std::array<int, 4>>& tetrahedra,
             const ProgressCallback& progress) {
    Changeable mesh(points, tetrahedra);
    // What is exchanged is looked at again in the same round, and neighbourhoods can take turns at being the better one.
    const std::size_t most_tried = most_tries * (tetrahedra.size() + 1);
    std::size_t tried = 0;
    for (int round = 0; round < most_rounds; ++round) {
        bool changed = false;
        for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
            if (!mesh.alive[t] || mesh.quality(mesh.tets[t]) >= wanted_quality) continue;
            if (progress && tried % tries_between == 0) progress(0);
            if (++tried > most_tried) break;
            if (exchange_around(mesh, t)) {
                changed = true;
                continue;
            }
            const Tet corners = mesh.tets[t];
            for (const int v : corners) changed |= move_point(polyhedron, mesh, v);
        }
        if (!changed || tried > most_tried) break;
    }
    tetrahedra.clear();
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        if (mesh.alive[t]) tetrahedra.push_back(mesh.tets[t]);
}

} // namespace kaya
