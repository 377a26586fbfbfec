#include "mechanics/supports/held_directions.hpp"
#include "mechanics/ties/ties.hpp"
#include "model/edit/ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace kaya {

namespace {

/// Ratio of the stiffness of a spring to that of the stiffer zone on which it acts: it deforms by a fiftieth of their deformation. Equation
/// (5) of docs/theory/ties.md.
constexpr double stiffer = 50;

Row root_of(std::vector<Row>& parent, Row i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// Confined modulus over height of the zone behind a triangle, at its creation: stress/length.
double zone_stiffness(const Model& model, const ElasticConstants& elastic, Row zone,
                      const std::array<Row, 3>& triangle) {
    const auto& x = model.gridpoints.reference;
    const double doubled = (x[triangle[1]] - x[triangle[0]]).cross(x[triangle[2]] - x[triangle[0]]).norm();
    const double height = 6 * model.zones.volume[zone] / doubled;
    return (std::max(elastic.lambda, 0.0) + elastic.two_shear) / height;
}

} // namespace

TieLists::TieLists(const Model& model, const std::vector<ElasticConstants>& elastic) {
    if (model.ties.empty()) return;
    find_groups(model);
    find_springs(model, elastic);
}

void TieLists::find_groups(const Model& model) {
    const auto& points = model.gridpoints;
    std::vector<Row> parent(points.size());
    std::iota(parent.begin(), parent.end(), Row{0});
    grouped_.assign(points.size(), 0);
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> rows;
        if (!blocks_of_pair(model, static_cast<Row>(p), rows)) continue;
        const Span span = model.tied_pairs.ties[p];
        for (Row t = span.first; t < span.end(); ++t) {
            if (!model.ties.exact[t]) continue;
            const Row g1 = model.blocks.gridpoints[rows[0]].first + model.ties.gridpoints1[t][0];
            const Row g2 = model.blocks.gridpoints[rows[1]].first + model.ties.gridpoints2[t][0];
            grouped_[g1] = grouped_[g2] = 1;
            const Row a = root_of(parent, g1), b = root_of(parent, g2);
            parent[std::max(a, b)] = std::min(a, b); // the lowest row leads
        }
    }
    for (std::size_t g = 0; g < points.size(); ++g)
        if (grouped_[g]) members_.push_back(static_cast<Row>(g));
    if (members_.empty()) return grouped_.clear();
    std::vector<Row> leader(points.size(), no_row);
    for (const Row g : members_) leader[g] = root_of(parent, g);
    std::stable_sort(members_.begin(), members_.end(), [&](Row a, Row b) { return leader[a] < leader[b]; });
    for (std::size_t i = 1; i <= members_.size(); ++i)
        if (i == members_.size() || leader[members_[i]] != leader[members_[i - 1]]) start_.push_back(i);
    for (std::size_t i = 0; i < groups(); ++i) {
        Roller held;
        for (const Row g : members(i)) add_directions(held, model.rollers[static_cast<std::size_t>(points.roller[g])]);
        rollers_.push_back(held);
    }
}

/// The springs of two faces, from `first` on, whose stiffness is still their area. `areas` are those of all means so far.
void TieLists::find_means(std::size_t first, std::vector<double>& areas) {
    std::array<std::map<Row, Row>, 2> gridpoints;
    for (std::size_t i = first; i < springs_.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t k = 0; k < 3; ++k)
                if (springs_[i].side[side].weights[k] != 0)
                    gridpoints[side].emplace(springs_[i].side[side].gridpoints[k], no_row);
    const std::size_t side = gridpoints[1].size() > gridpoints[0].size() ? 1 : 0;
    for (auto& [gridpoint, mean] : gridpoints[side]) {
        mean = static_cast<Row>(areas.size());
        areas.push_back(0);
    }
    for (std::size_t i = first; i < springs_.size(); ++i) {
        Spring& spring = springs_[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = spring.side[side].weights[k];
            if (weight == 0) continue;
            spring.mean[k] = gridpoints[side].at(spring.side[side].gridpoints[k]);
            spring.part[k] = weight;
            areas[static_cast<std::size_t>(spring.mean[k])] += weight * spring.stiffness;
        }
    }
}

void TieLists::find_springs(const Model& model, const std::vector<ElasticConstants>& elastic) {
    std::vector<double> areas;
    const auto& ties = model.ties;
    const auto& blocks = model.blocks;
    for (std::size_t p = 0; p < model.tied_pairs.size(); ++p) {
        std::array<Row, 2> rows;
        if (!blocks_of_pair(model, static_cast<Row>(p), rows)) continue;
        const auto attached = [&](int side, const std::array<Row, 3>& gridpoints,
                                  const std::array<double, 3>& weights) {
            Attachment a{gridpoints, weights};
            for (Row& g : a.gridpoints) g += blocks.gridpoints[rows[side]].first;
            return a;
        };
        const Span span = model.tied_pairs.ties[p];
        for (Row first = span.first; first < span.end();) {
            // Two faces have one stiffness per area: a uniform stress passes without bending them.
            Row end = first;
            double stiffest = 0;
            const std::size_t first_spring = springs_.size();
            for (; end < span.end() && ties.face1[end] == ties.face1[first] && ties.face2[end] == ties.face2[first];
                 ++end) {
                if (ties.exact[end]) continue;
                const Spring spring{end,
                                    {attached(0, ties.gridpoints1[end], ties.weights1[end]),
                                     attached(1, ties.gridpoints2[end], ties.weights2[end])},
                                    ties.area[end],
                                    {no_row, no_row, no_row},
                                    {}};
                const std::array<Row, 2> zones{ties.zone1[end], ties.zone2[end]};
                for (int side = 0; side < 2; ++side)
                    stiffest = std::max(stiffest, zone_stiffness(model, elastic[rows[side]],
                                                                 blocks.zones[rows[side]].first + zones[side],
                                                                 spring.side[side].gridpoints));
                springs_.push_back(spring);
            }
            find_means(first_spring, areas);
            for (std::size_t i = first_spring; i < springs_.size(); ++i) springs_[i].stiffness *= stiffer * stiffest;
            first = end;
        }
    }
    if (springs_.empty()) return;
    means_ = sorted_lists<Member>(areas.size(), [&](auto add) {
        for (std::size_t i = 0; i < springs_.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (const Row mean = springs_[i].mean[k]; mean != no_row)
                    add(mean, Member{static_cast<Row>(i), ties.area[springs_[i].tie] * springs_[i].part[k] /
                                                              areas[static_cast<std::size_t>(mean)]});
    });
    shares_ = sorted_lists<Share>(model.gridpoints.size(), [&](auto add) {
        for (const Spring& spring : springs_)
            for (int side = 0; side < 2; ++side)
                for (int k = 0; k < 3; ++k)
                    if (const double weight = spring.side[side].weights[k]; weight != 0)
                        add(spring.side[side].gridpoints[k], Share{spring.tie, side == 0 ? -weight : weight});
    });
}

void add_tie_frequencies(Model& model, const TieLists& ties) {
    auto& points = model.gridpoints;
    // A spring's stiffness matrix k w w' is at most diag(k |w_i| sum |w_j|), and the weights of each side sum
    // to 1.
    for (const auto& spring : ties.springs())
        for (const Attachment& side : spring.side)
            for (int k = 0; k < 3; ++k)
                if (const Row g = side.gridpoints[k]; side.weights[k] != 0 && points.mass[g] > 0)
                    points.zone_frequency[g] += 2 * spring.stiffness * side.weights[k] / points.mass[g];
}

} // namespace kaya
