#include "geometry/mesh/mesh_mending.hpp"

#include "geometry/mesh/mesh_points.hpp"
#include "geometry/mesh/tet_improvement.hpp"
#include "geometry/mesh/tet_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace kaya {
namespace {

using Tet = ChangeableTets::Tet;

/// Below this part of a fair angle an edge is divided, on the surface too.
constexpr double poor = 0.8;
/// Least gain in the sine of the worst angle, and how often it is done in a block.
constexpr double gain_of_division = 0.01;
constexpr int most_divisions = 2;

double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }

bool changeable(const TetMesh& mesh) { return !mesh.tetrahedra.empty() && mesh.per_cell == 0; }

bool is_bad(const TetMesh& mesh, double fair_sine) {
    return std::ranges::any_of(mesh.tetrahedra, [&](const Tet& t) {
        const auto& p = mesh.points;
        return least_sine(p[t[0]], p[t[1]], p[t[2]], p[t[3]], false) < fair_sine;
    });
}

/// The worst tetrahedron of the block in the middle.
int worst_own(const ChangeableTets& tets) {
    int worst = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(tets.tets.size()); ++t) {
        if (!tets.alive[t] || tets.block[t] != 0) continue;
        const double quality = tets.quality(tets.tets[t]);
        if (quality >= least) continue;
        least = quality;
        worst = t;
    }
    return worst;
}

double quality_of_worst(const ChangeableTets& tets) { return tets.quality(tets.tets[worst_own(tets)]); }

/// Whether new tetrahedra of other blocks are good enough, or no worse than those they replace.
bool others_are_fair(const ChangeableTets& before, const ChangeableTets& now) {
    std::vector<double> least(1 + static_cast<std::size_t>(*std::ranges::max_element(now.block)), least_of_others);
    const std::size_t count = before.tets.size();
    for (std::size_t t = 0; t < count; ++t)
        if (before.alive[t] && !now.alive[t])
            least[before.block[t]] = std::min(least[before.block[t]], before.quality(before.tets[t]));
    for (std::size_t t = count; t < now.tets.size(); ++t)
        if (now.alive[t] && now.block[t] != 0 && now.quality(now.tets[t]) < least[now.block[t]]) return false;
    return true;
}

/// Divides that edge of the worst tetrahedron which makes the block good enough, or best. False when none makes it better.
bool divide_at_worst(Neighbourhood& around, double enough, const ProgressCallback& progress) {
    const ChangeableTets before = around.tets;
    ChangeableTets best = before;
    const Tet bad = before.tets[worst_own(before)];
    const double start = quality_of_worst(before) + gain_of_division;
    double best_quality = start;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            if (best_quality >= enough || !around.divide(bad[i], bad[j])) continue;
            improve_angles(around.tets, enough, progress);
            const double quality = quality_of_worst(around.tets);
            if (quality > best_quality && others_are_fair(before, around.tets)) {
                best_quality = quality;
                best = around.tets;
            }
            around.tets = before;
        }
    around.tets = std::move(best);
    return best_quality > start;
}

/// A block and those that share an edge with it.
class Edges {
public:
    explicit Edges(const MeshedBlocks& together) : together_(together) {
        for (std::size_t b = 0; b < together.blocks.size(); ++b)
            for (const SharedEdge& edge : of(b)) at_.push_back({edge, b});
        std::ranges::sort(at_);
    }
    std::set<std::size_t> neighbours(std::size_t block) const {
        std::set<std::size_t> found;
        for (const SharedEdge& edge : of(block))
            for (auto at = std::ranges::lower_bound(at_, std::pair{edge, std::size_t{0}});
                 at != at_.end() && at->first == edge; ++at)
                found.insert(at->second);
        found.erase(block);
        return found;
    }

private:
    std::set<SharedEdge> of(std::size_t block) const {
        std::set<SharedEdge> edges;
        const std::vector<int>& numbers = together_.numbers[block];
        for (const auto& face : together_.blocks[block].faces)
            for (std::size_t i = 0; i < face.vertices.size(); ++i) {
                const int a = numbers[face.vertices[i]], b = numbers[face.vertices[(i + 1) % face.vertices.size()]];
                edges.insert({std::min(a, b), std::max(a, b)});
            }
        return edges;
    }

    const MeshedBlocks& together_;
    std::vector<std::pair<SharedEdge, std::size_t>> at_;
};

} // namespace

void mend_meshes(const MeshedBlocks& together, std::vector<TetMesh>& meshes, const ProgressCallback& progress) {
    std::vector<std::size_t> bad;
    for (std::size_t b = 0; b < meshes.size(); ++b)
        if (changeable(meshes[b]) && is_bad(meshes[b], sine(fair_angle_of(together.blocks[b])))) bad.push_back(b);
    if (bad.empty()) return;
    // The same order and the same neighbours, however blocks are numbered.
    std::vector<std::vector<int>> names(together.numbers);
    for (auto& name : names) std::ranges::sort(name);
    const auto by_name = [&](std::size_t a, std::size_t b) { return names[a] < names[b]; };
    std::ranges::sort(bad, by_name);
    const Edges edges(together);
    for (const std::size_t block : bad) {
        if (progress) progress(0);
        Neighbourhood around(together, meshes, block);
        const auto neighbours = edges.neighbours(block);
        std::vector<std::size_t> ordered(neighbours.begin(), neighbours.end());
        std::ranges::sort(ordered, by_name);
        for (const std::size_t other : ordered)
            if (changeable(meshes[other])) around.add(other);
        improve_angles(around.tets, good_sine, progress);
        const double enough = sine(poor * fair_angle_of(together.blocks[block]));
        for (int i = 0; i < most_divisions && quality_of_worst(around.tets) < enough; ++i) {
            if (!divide_at_worst(around, enough, progress)) break;
            improve_angles(around.tets, good_sine, progress);
        }
        around.give_back();
    }
}

} // namespace kaya
