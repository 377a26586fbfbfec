// Hill climbing on the shape of the worst tetrahedron, with the moves of Freitag and Ollivier-Gooch 1997
// (Int. J. Numer. Meth. Engng 40) and the removal of edges by the best triangulation of the ring
// around them (Klincsek 1980; de l'Isle and George 1995).
#include "geometry/tet_improvement.hpp"

#include "geometry/tet_shape.hpp"

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
/// And those with an angle between two faces below 25 degrees or above 155; new points are for those below 18 or above 162.
constexpr double wanted_sine = 0.42, wanted_of_points = 0.309;
/// What a new point has to be worth: it makes ten tetrahedra or so of one.
constexpr double gain_of_point = 0.02;
constexpr double least_gain = 1e-3;
constexpr int most_rounds = 12;
constexpr std::size_t most_tries = 100;     ///< in all rounds, for each tetrahedron; a dozen is much
constexpr std::size_t tries_between = 1024; ///< two calls of a ProgressCallback
/// Rings of more points are left alone: their edge is seldom the cause of a bad shape.
constexpr std::size_t longest_ring = 9;

/// What is made better: the shape as a whole, the least angle between faces, the worse of both.
enum class Measure { shape, both, angle };

/// A mesh that can be changed: dead tetrahedra keep their place until the end.
class Changeable {
public:
    Changeable(MeshPoints& mesh_points, const std::vector<Tet>& given)
        : points(mesh_points), at_point(mesh_points.points.size()), changed_at(mesh_points.points.size(), 1) {
        for (const Tet& t : given) add(t);
    }

    void add(const Tet& t) {
        for (const int v : t) at_point[v].push_back(static_cast<int>(tets.size()));
        tets.push_back(t);
        alive.push_back(true);
        seen.push_back(0);
        ++clock;
        for (const int v : t) changed_at[v] = clock;
    }
    void remove(int number) {
        alive[number] = false;
        for (const int v : tets[number]) std::erase(at_point[v], number);
    }
    double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
        return measure == Measure::shape ? shape_quality(a, b, c, d) : least_sine(a, b, c, d, measure == Measure::both);
    }
    double quality(const Tet& t) const {
        const auto& p = points.points;
        return quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
    }
    int add_point(const Vec3& x) {
        points.add(x, {});
        at_point.emplace_back();
        changed_at.push_back(0);
        return static_cast<int>(points.points.size()) - 1;
    }
    /// Of the tetrahedra at a point; any number up to the floor when it is not above that.
    double worst_at(int point, double floor = -std::numeric_limits<double>::infinity()) const {
        double worst = 1;
        for (const int t : at_point[point]) {
            worst = std::min(worst, quality(tets[t]));
            if (worst <= floor) break;
        }
        return worst;
    }
    /// Whether anything has changed around a tetrahedron since it was looked at last.
    bool fresh(int number) const {
        return std::ranges::any_of(tets[number], [&](int v) { return changed_at[v] > seen[number]; });
    }
    void mark_seen(int number) { seen[number] = ++clock; }
    void has_moved(int point) {
        ++clock;
        for (const int t : at_point[point])
            for (const int v : tets[t]) changed_at[v] = clock;
    }
    std::vector<int> around_edge(int a, int b) const {
        std::vector<int> result;
        for (const int t : at_point[a])
            if (std::find(tets[t].begin(), tets[t].end(), b) != tets[t].end()) result.push_back(t);
        return result;
    }

    MeshPoints& points;
    Measure measure = Measure::shape;
    std::vector<Tet> tets;
    std::vector<bool> alive;
    std::vector<std::vector<int>> at_point;
    std::size_t clock = 1;
    std::vector<std::size_t> changed_at, seen; ///< points, tetrahedra
};

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

/// Climbs to where the worst tetrahedron at the point is best. Points of the surface stay.
bool move_point(Changeable& mesh, int point) {
    if (!mesh.points.faces[point].empty()) return false;
    double best = mesh.worst_at(point);
    const double start = best, reach = mean_edge_at(mesh, point);
    for (double step = 0.25 * reach; step > 0.01 * reach;) {
        const Vec3 here = mesh.points.points[point];
        Vec3 target = here;
        for (int i = 0; i < 27; ++i) {
            if (i == 13) continue;
            const Vec3 direction = Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized();
            mesh.points.points[point] = here + step * direction;
            const double worst = mesh.worst_at(point, best + least_gain);
            if (worst <= best + least_gain) continue;
            best = worst;
            target = mesh.points.points[point];
        }
        mesh.points.points[point] = target;
        if (target == here) step /= 2;
    }
    if (best > start) mesh.has_moved(point);
    return best > start;
}

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

Ring ring_around(const Changeable& mesh, int a, int b, const std::vector<int>& tets) {
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
    if (ring.points.size() < 3 || !ring.closed) return false; // edges of the surface stay
    const Filling filling = best_filling(mesh, a, b, ring.points);
    if (filling.quality <= worst_of(mesh, tets) + least_gain) return false;
    exchange(mesh, tets, filling.tets);
    return true;
}

/// Three tetrahedra around a new edge instead of two with a common triangle.
bool insert_edge(Changeable& mesh, int number, int corner) {
    Tet t = mesh.tets[number];
    const int apex = t[corner];
    // With the apex after it of positive orientation, by the order of corners, since the tetrahedron may be flat.
    const std::array<int, 3> side{t[seen_from_corner[corner][0]], t[seen_from_corner[corner][1]],
                                  t[seen_from_corner[corner][2]]};
    int other = -1;
    for (const int candidate : mesh.around_edge(side[0], side[1])) {
        const Tet& c = mesh.tets[candidate];
        if (candidate != number && std::find(c.begin(), c.end(), side[2]) != c.end()) other = candidate;
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
    if (worst <= worst_of(mesh, {number, other}) + least_gain) return false;
    exchange(mesh, {number, other}, fresh);
    return true;
}

/// A hole in the mesh and a point in it that is joined to all its sides.
class Hole {
public:
    Hole(const Changeable& mesh, int number) : mesh_(mesh) {
        const Tet& t = mesh.tets[number];
        for (const int v : t) place_ += 0.25 * mesh.points.points[v];
        take(number);
    }

    /// Takes in the tetrahedron beyond the worst side until all are good enough or none can be taken.
    void grow(double wanted) {
        constexpr std::size_t most = 40;
        while (tets_.size() < most) {
            std::size_t worst = sides_.size();
            double least = wanted;
            for (std::size_t i = 0; i < sides_.size(); ++i) {
                if (sides_[i].next < 0) continue;
                const double q = quality_of(sides_[i]);
                if (q >= least) continue;
                least = q;
                worst = i;
            }
            if (worst == sides_.size()) return;
            take(sides_[worst].next);
        }
    }
    /// Moves the point to where the worst of its tetrahedra is best.
    double climb() {
        double best = worst();
        double reach = 0;
        for (const Side& side : sides_)
            reach =
                std::max(reach, (mesh_.points.points[side.corners[0]] - mesh_.points.points[side.corners[1]]).norm());
        for (double step = 0.25 * reach; step > 0.01 * reach;) {
            const Vec3 here = place_;
            Vec3 target = here;
            for (int i = 0; i < 27; ++i) {
                if (i == 13) continue;
                place_ = here + step * Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized();
                const double now = worst(best + least_gain);
                if (now <= best + least_gain) continue;
                best = now;
                target = place_;
            }
            place_ = target;
            if (target == here) step /= 2;
        }
        return best;
    }
    const std::vector<int>& tets() const { return tets_; }
    const Vec3& place() const { return place_; }
    std::vector<Tet> filled(int point) const {
        std::vector<Tet> fresh;
        for (const Side& side : sides_) fresh.push_back({side.corners[0], side.corners[1], side.corners[2], point});
        return fresh;
    }

private:
    struct Side {
        std::array<int, 3> corners; ///< anticlockwise seen from inside
        int next;                   ///< the tetrahedron there, -1 for the surface
    };

    void take(int number) {
        tets_.push_back(number);
        const Tet& t = mesh_.tets[number];
        for (const auto& corner : seen_from_corner) {
            const Side side{{t[corner[0]], t[corner[1]], t[corner[2]]}, -1};
            const auto same =
                std::ranges::find_if(sides_, [&](const Side& other) { return same_corners(side, other); });
            if (same != sides_.end()) sides_.erase(same);
            else sides_.push_back({side.corners, neighbour(number, side.corners)});
        }
    }
    static bool same_corners(const Side& a, const Side& b) {
        return std::ranges::all_of(a.corners,
                                   [&](int v) { return std::ranges::find(b.corners, v) != b.corners.end(); });
    }
    int neighbour(int number, const std::array<int, 3>& side) const {
        for (const int candidate : mesh_.at_point[side[0]]) {
            const Tet& c = mesh_.tets[candidate];
            if (candidate != number && std::ranges::find(c, side[1]) != c.end() &&
                std::ranges::find(c, side[2]) != c.end())
                return candidate;
        }
        return -1;
    }
    double quality_of(const Side& side) const {
        const auto& p = mesh_.points.points;
        return mesh_.quality(p[side.corners[0]], p[side.corners[1]], p[side.corners[2]], place_);
    }
    double worst(double floor = -std::numeric_limits<double>::infinity()) const {
        double least = 1;
        for (const Side& side : sides_) {
            least = std::min(least, quality_of(side));
            if (least <= floor) break;
        }
        return least;
    }

    const Changeable& mesh_;
    Vec3 place_ = Vec3::Zero();
    std::vector<int> tets_;
    std::vector<Side> sides_;
};

/// A new point in the place of a bad tetrahedron and of those around it.
bool insert_point(Changeable& mesh, int number, double wanted) {
    Hole hole(mesh, number);
    hole.grow(wanted);
    const double now = worst_of(mesh, hole.tets());
    if (hole.climb() <= now + gain_of_point) return false;
    const int point = mesh.add_point(hole.place());
    exchange(mesh, hole.tets(), hole.filled(point));
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

/// Goes on while the worst get better, below what is wanted.
void climb(Changeable& mesh, double wanted, bool new_points, const ProgressCallback& progress) {
    // What is exchanged is looked at again in the same round, and neighbourhoods can take turns at being the better one.
    const std::size_t most_tried = most_tries * (mesh.tets.size() + 1);
    std::size_t tried = 0;
    for (int round = 0; round < most_rounds; ++round) {
        bool changed = false;
        for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
            if (!mesh.alive[t] || !mesh.fresh(t) || mesh.quality(mesh.tets[t]) >= wanted) continue;
            if (progress && tried % tries_between == 0) progress(0);
            if (++tried > most_tried) break;
            if (exchange_around(mesh, t)) {
                changed = true;
                continue;
            }
            const Tet corners = mesh.tets[t];
            bool moved = false;
            for (const int v : corners) moved |= move_point(mesh, v);
            if (!moved && new_points) moved = insert_point(mesh, t, wanted);
            if (!moved) mesh.mark_seen(t);
            changed |= moved;
        }
        if (!changed || tried > most_tried) break;
    }
}

} // namespace

void improve(MeshPoints& points, std::vector<std::array<int, 4>>& tetrahedra, bool new_points,
             const ProgressCallback& progress) {
    Changeable mesh(points, tetrahedra);
    const auto improve_by = [&](Measure measure, double wanted, bool with_points) {
        mesh.measure = measure;
        std::ranges::fill(mesh.seen, 0);
        climb(mesh, wanted, with_points, progress);
    };
    improve_by(Measure::shape, wanted_quality, false);
    improve_by(Measure::both, wanted_sine, false);
    if (new_points) improve_by(Measure::angle, wanted_of_points, true);
    // A point whose tetrahedra have all been taken out is none.
    MeshPoints kept;
    std::vector<int> number(points.points.size(), -1);
    for (std::size_t p = 0; p < points.points.size(); ++p) {
        if (mesh.at_point[p].empty()) continue;
        number[p] = static_cast<int>(kept.points.size());
        kept.add(points.points[p], std::move(points.faces[p]));
    }
    tetrahedra.clear();
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (!mesh.alive[t]) continue;
        tetrahedra.push_back(mesh.tets[t]);
        for (int& v : tetrahedra.back()) v = number[v];
    }
    points = std::move(kept);
}

} // namespace kaya
