#include "geometry/mesh/tet_exchanges.hpp"

#include "geometry/mesh/tet_shape.hpp"

#include <limits>

namespace kaya {
namespace {

using Tet = ChangeableTets::Tet;

/// Rings of more points are left alone: their edge is seldom the cause of a bad shape.
constexpr std::size_t longest_ring = 9;

/// The points around the edge from a to b, anticlockwise seen from b; closed when the edge is inside.
struct Ring {
    std::vector<int> points;
    bool closed = false;
};

/// The other two corners p, q of a tetrahedron: a b p q is of positive orientation. By the order of its corners, since it may be flat.
std::array<int, 2> opposite_edge(const Tet& t, int a, int b) {
    const auto i = std::find(t.begin(), t.end(), a) - t.begin(), j = std::find(t.begin(), t.end(), b) - t.begin();
    std::array<int, 2> other{};
    std::ptrdiff_t found = 0, inversions = i > j;
    for (std::ptrdiff_t k = 0; k < 4; ++k) {
        if (k == i || k == j) continue;
        other[static_cast<std::size_t>(found++)] = t[static_cast<std::size_t>(k)];
        inversions += (k < i) + (k < j);
    }
    if (inversions % 2 != 0) std::swap(other[0], other[1]);
    return other;
}

Ring ring_around(const ChangeableTets& mesh, int a, int b, const std::vector<int>& tets) {
    std::vector<std::array<int, 2>> steps;
    for (const int number : tets) { steps.push_back(opposite_edge(mesh.tets[number], a, b)); }
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

/// The best way to fill a ring with triangles, each making one tetrahedron with a and one with b. Of an open ring the last side joins its ends.
struct Filling {
    double quality = -1;
    std::vector<Tet> tets;
};

Filling best_filling(const ChangeableTets& mesh, int a, int b, const std::vector<int>& ring) {
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

/// Tetrahedra around an edge, by block.
std::vector<std::vector<int>> by_block(const ChangeableTets& mesh, const std::vector<int>& tets) {
    std::vector<std::vector<int>> sides;
    for (const int t : tets) {
        const auto same =
            std::ranges::find_if(sides, [&](const auto& side) { return mesh.block[side.front()] == mesh.block[t]; });
        if (same == sides.end()) sides.push_back({t});
        else same->push_back(t);
    }
    return sides;
}

bool in_open_face(const ChangeableTets& mesh, const std::vector<int>& points) {
    return std::ranges::any_of(common_faces(mesh.points, points),
                               [&](int f) { return std::ranges::find(mesh.open_faces, f) != mesh.open_faces.end(); });
}

/// Turns an edge of the surface, in the tetrahedra on all sides of it.
bool turn_edge(ChangeableTets& mesh, int a, int b, const std::vector<std::vector<int>>& sides) {
    std::vector<Filling> fillings;
    std::array<int, 2> ends{-1, -1}; // of the new edge
    bool better = false;
    for (const auto& side : sides) {
        const Ring ring = ring_around(mesh, a, b, side);
        if (ring.closed || ring.points.size() < 3 || ring.points.size() > longest_ring) return false;
        const int first = ring.points.front(), last = ring.points.back();
        const std::array<int, 2> across{std::min(first, last), std::max(first, last)};
        if (ends[0] >= 0 && ends != across) return false;
        ends = across;
        fillings.push_back(best_filling(mesh, a, b, ring.points));
        const double now = mesh.worst_of(side), then = fillings.back().quality;
        const bool own = mesh.block[side.front()] == 0;
        if (own ? then <= now + least_gain : then < std::min(now, least_of_others)) return false;
        better |= own;
    }
    if (!better || !in_open_face(mesh, {a, b, ends[0], ends[1]})) return false;
    for (std::size_t i = 0; i < sides.size(); ++i) mesh.exchange(sides[i], fillings[i].tets);
    mesh.surface_changes.push_back({a, b, ends[0], ends[1]});
    return true;
}

} // namespace

ChangeableTets::ChangeableTets(MeshPoints mesh_points, const std::vector<Tet>& given)
    : points(std::move(mesh_points)), at_point(points.points.size()), changed_at_(points.points.size(), 1),
      settled_(points.points.size(), 0) {
    for (const auto& faces : points.faces) motions.push_back({faces.empty() ? Freedom::anywhere : Freedom::nowhere});
    for (const Tet& t : given) add(t, 0);
}

void ChangeableTets::add(const Tet& t, int of_block) {
    for (const int v : t) at_point[v].push_back(static_cast<int>(tets.size()));
    tets.push_back(t);
    block.push_back(of_block);
    alive.push_back(true);
    seen_.push_back(0);
    ++clock_;
    for (const int v : t) changed_at_[v] = clock_;
}

void ChangeableTets::remove(int number) {
    alive[number] = false;
    for (const int v : tets[number]) std::erase(at_point[v], number);
}

void ChangeableTets::exchange(const std::vector<int>& old_tets, const std::vector<Tet>& new_tets) {
    const int of_block = block[old_tets.front()];
    for (const int t : old_tets) remove(t);
    for (const Tet& t : new_tets) add(t, of_block);
}

int ChangeableTets::add_point(const Vec3& x, std::vector<int> on_faces, Motion motion) {
    points.add(x, std::move(on_faces));
    motions.push_back(motion);
    at_point.emplace_back();
    changed_at_.push_back(0);
    settled_.push_back(0);
    return static_cast<int>(points.points.size()) - 1;
}

double ChangeableTets::quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
    return measure == Measure::shape ? shape_quality(a, b, c, d) : least_sine(a, b, c, d, measure == Measure::both);
}

double ChangeableTets::quality(const Tet& t) const {
    const auto& p = points.points;
    return quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
}

double ChangeableTets::worst_of(const std::vector<int>& numbers) const {
    double worst = 1;
    for (const int t : numbers) worst = std::min(worst, quality(tets[t]));
    return worst;
}

void ChangeableTets::has_moved(int point) {
    ++clock_;
    for (const int t : at_point[point])
        for (const int v : tets[t]) changed_at_[v] = clock_;
}

std::vector<int> ChangeableTets::around_edge(int a, int b) const {
    if (at_point[b].size() < at_point[a].size()) std::swap(a, b);
    std::vector<int> result;
    for (const int t : at_point[a]) // in the order in which they were added, whichever end it is
        if (std::find(tets[t].begin(), tets[t].end(), b) != tets[t].end()) result.push_back(t);
    return result;
}

bool remove_edge(ChangeableTets& mesh, int a, int b) {
    const std::vector<int> tets = mesh.around_edge(a, b);
    if (tets.size() < 2) return false;
    if (!mesh.open_faces.empty()) {
        const auto sides = by_block(mesh, tets);
        if (sides.size() > 1 || in_open_face(mesh, {a, b})) return turn_edge(mesh, a, b, sides);
    }
    if (tets.size() >= longest_ring) return false;
    const Ring ring = ring_around(mesh, a, b, tets);
    if (ring.points.size() < 3 || !ring.closed) return false; // edges of the surface stay
    const Filling filling = best_filling(mesh, a, b, ring.points);
    if (filling.quality <= mesh.worst_of(tets) + least_gain) return false;
    mesh.exchange(tets, filling.tets);
    return true;
}

bool insert_edge(ChangeableTets& mesh, int number, int corner) {
    const Tet t = mesh.tets[number];
    const int apex = t[corner];
    // With the apex after it of positive orientation, by the order of corners, since the tetrahedron may be flat.
    const std::array<int, 3> side{t[seen_from_corner[corner][0]], t[seen_from_corner[corner][1]],
                                  t[seen_from_corner[corner][2]]};
    int other = -1;
    for (const int candidate : mesh.around_edge(side[0], side[1])) {
        const Tet& c = mesh.tets[candidate];
        if (candidate != number && mesh.block[candidate] == mesh.block[number] &&
            std::find(c.begin(), c.end(), side[2]) != c.end())
            other = candidate;
    }
    if (other < 0) return false;
    int far = -1;
    for (const int v : mesh.tets[other])
        if (std::find(side.begin(), side.end(), v) == side.end()) far = v;
    std::vector<Tet> fresh;
    double worst = 1;
    for (int i = 0; i < 3; ++i) {
        fresh.push_back({far, apex, side[i], side[(i + 1) % 3]});
        worst = std::min(worst, mesh.quality(fresh.back()));
    }
    if (worst <= mesh.worst_of({number, other}) + least_gain) return false;
    mesh.exchange({number, other}, fresh);
    return true;
}

void divide_edge(ChangeableTets& mesh, int a, int b, std::vector<int> faces, const Motion& motion) {
    const bool on_surface = !faces.empty();
    const Vec3 middle = 0.5 * (mesh.points.points[a] + mesh.points.points[b]);
    const int point = mesh.add_point(middle, std::move(faces), motion);
    for (const int number : mesh.around_edge(a, b)) {
        Tet first = mesh.tets[number], second = first;
        std::ranges::replace(first, a, point);
        std::ranges::replace(second, b, point);
        mesh.exchange({number}, {first, second});
    }
    if (on_surface) mesh.surface_changes.push_back({a, b, point, -1});
}

} // namespace kaya
