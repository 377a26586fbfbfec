// Hill climbing on the shape of the worst tetrahedron, with the moves of Freitag and Ollivier-Gooch 1997
// (Int. J. Numer. Meth. Engng 40).
#include "geometry/mesh/tet_improvement.hpp"

#include "geometry/mesh/tet_shape.hpp"

#include "base/stop_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace kaya {
namespace {

using Tet = ChangeableTets::Tet;

/// Tetrahedra below this are worked on; body-centred ones have 0.95.
constexpr double wanted_quality = 0.45;
/// Also those with an angle between two faces below 25 degrees or above 155; new points are for those below 18 or above 162.
constexpr double wanted_sine = 0.42;
/// Least gain of a new point, which replaces one tetrahedron by some ten.
constexpr double gain_of_point = 0.02;
constexpr int most_rounds = 12;
constexpr std::size_t most_tries = 100;     ///< in all rounds, for each tetrahedron; a dozen is much
constexpr std::size_t tries_between = 1024; ///< two calls of a ProgressCallback

double mean_edge_at(const ChangeableTets& mesh, int point) {
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

/// The worst quality of the tetrahedra at a point; any value up to the floor when it is not above that. Those of other blocks count where
/// they are below their limit.
class WorstAt {
public:
    WorstAt(const ChangeableTets& mesh, int point) : mesh_(mesh) {
        for (const int t : mesh.at_point[point]) {
            const bool own = mesh.block[t] == 0;
            around_.push_back({mesh.tets[t], own ? 0 : std::min(least_of_others, mesh.quality(mesh.tets[t])), own});
        }
    }
    double operator()(double floor = -std::numeric_limits<double>::infinity()) {
        double worst = 1;
        for (std::size_t i = 0; i < around_.size(); ++i) {
            const Corner& corner = around_[i];
            double quality = mesh_.quality(corner.tet);
            if (!corner.own) quality = quality >= corner.least ? 1 : floor;
            if (quality >= worst) continue;
            worst = quality;
            if (worst > floor) continue;
            std::swap(around_[i], around_.front()); // it is likely to fail next time
            break;
        }
        return worst;
    }

private:
    struct Corner {
        Tet tet;
        double least; ///< of tetrahedra of other blocks
        bool own;
    };
    const ChangeableTets& mesh_;
    std::vector<Corner> around_;
};

/// Unit vectors along the axes and along the diagonals between three of them.
const std::vector<Vec3>& directions_in_space() {
    static const std::vector<Vec3> all = [] {
        std::vector<Vec3> directions;
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) directions.push_back(sign * Vec3::Unit(axis));
        for (int i = 0; i < 8; ++i)
            directions.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).normalized());
        return directions;
    }();
    return all;
}

/// Unit vectors in which a point can set out.
std::vector<Vec3> directions_of(const Motion& motion) {
    if (motion.freedom == Freedom::nowhere) return {};
    if (motion.freedom == Freedom::along_line) return {motion.axis, -motion.axis};
    if (motion.freedom == Freedom::anywhere) return directions_in_space();
    std::vector<Vec3> directions;
    const Vec3 u = motion.axis.unitOrthogonal(), v = motion.axis.cross(u);
    for (int i = 0; i < 9; ++i)
        if (i != 4) directions.push_back(((i % 3 - 1) * u + (i / 3 - 1) * v).normalized());
    return directions;
}

/// Climbs to where the worst tetrahedron at the point is best.
bool move_point(ChangeableTets& mesh, int point) {
    if (!mesh.can_move(point)) return false;
    const std::vector<Vec3> directions = directions_of(mesh.motions[point]);
    if (directions.empty()) return false;
    WorstAt worst_at(mesh, point);
    double best = worst_at();
    const double start = best, reach = mean_edge_at(mesh, point);
    for (double step = 0.25 * reach; step > 0.01 * reach;) {
        const Vec3 here = mesh.points.points[point];
        Vec3 target = here;
        for (const Vec3& direction : directions) {
            mesh.points.points[point] = here + step * direction;
            const double worst = worst_at(best + least_gain);
            if (worst <= best + least_gain) continue;
            best = worst;
            target = mesh.points.points[point];
        }
        mesh.points.points[point] = target;
        if (target == here) step /= 2;
    }
    if (best > start) mesh.has_moved(point);
    else mesh.mark_settled(point);
    return best > start;
}

/// A hole in the mesh and a point in it that is joined to all its sides.
class Hole {
public:
    Hole(const ChangeableTets& mesh, int number) : mesh_(mesh) {
        const Tet& t = mesh.tets[number];
        for (const int v : t) place_ += 0.25 * mesh.points.points[v];
        take(number);
    }

    /// Adds the tetrahedron beyond the worst side until all are good enough or none can be added.
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
            for (const Vec3& direction : directions_in_space()) {
                place_ = here + step * direction;
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
            if (candidate != number && mesh_.block[candidate] == mesh_.block[number] &&
                std::ranges::find(c, side[1]) != c.end() && std::ranges::find(c, side[2]) != c.end())
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

    const ChangeableTets& mesh_;
    Vec3 place_ = Vec3::Zero();
    std::vector<int> tets_;
    std::vector<Side> sides_;
};

/// A new point replaces a bad tetrahedron and those around it.
bool insert_point(ChangeableTets& mesh, int number, double wanted) {
    Hole hole(mesh, number);
    hole.grow(wanted);
    const double now = mesh.worst_of(hole.tets());
    if (hole.climb() <= now + gain_of_point) return false;
    const int point = mesh.add_point(hole.place());
    mesh.exchange(hole.tets(), hole.filled(point));
    return true;
}

/// Tries all exchanges that would remove one tetrahedron.
bool exchange_around(ChangeableTets& mesh, int number) {
    const Tet t = mesh.tets[number];
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (remove_edge(mesh, t[i], t[j])) return true;
    for (int corner = 0; corner < 4; ++corner)
        if (insert_edge(mesh, number, corner)) return true;
    return false;
}

/// Continues while the worst improve, below the wanted quality.
void climb(ChangeableTets& mesh, double wanted, bool new_points, const ProgressCallback& progress) {
    // Exchanged tetrahedra are checked again in the same round, and neighbourhoods can alternate in being the better one.
    const std::size_t most_tried = most_tries * (mesh.tets.size() + 1);
    std::size_t tried = 0;
    constexpr int between_stops = 16; // tries
    StopPoints stops(between_stops);
    for (int round = 0; round < most_rounds; ++round) {
        bool changed = false;
        for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
            if (!mesh.alive[t] || mesh.block[t] != 0 || !mesh.fresh(t) || mesh.quality(mesh.tets[t]) >= wanted)
                continue;
            stops.pass();
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
    ChangeableTets mesh(std::move(points), tetrahedra);
    const auto improve_by = [&](Measure measure, double wanted, bool with_points) {
        mesh.measure = measure;
        mesh.revisit_all();
        climb(mesh, wanted, with_points, progress);
    };
    improve_by(Measure::shape, wanted_quality, false);
    improve_by(Measure::both, wanted_sine, false);
    if (new_points) improve_by(Measure::angle, good_sine, true);
    // A point without tetrahedra is dropped.
    MeshPoints kept;
    std::vector<int> number(mesh.points.points.size(), -1);
    for (std::size_t p = 0; p < mesh.points.points.size(); ++p) {
        if (mesh.at_point[p].empty()) continue;
        number[p] = static_cast<int>(kept.points.size());
        kept.add(mesh.points.points[p], std::move(mesh.points.faces[p]));
    }
    tetrahedra.clear();
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        if (!mesh.alive[t]) continue;
        tetrahedra.push_back(mesh.tets[t]);
        for (int& v : tetrahedra.back()) v = number[v];
    }
    points = std::move(kept);
}

void improve_angles(ChangeableTets& mesh, double wanted, const ProgressCallback& progress) {
    mesh.measure = Measure::angle;
    climb(mesh, wanted, false, progress);
}

} // namespace kaya
