#include "model/structures/rock_points.hpp"

#include "model/tables/model.hpp"
#include "model/kinds/nearest.hpp"
#include "model/kinds/selection.hpp"
#include "model/measure/block_box.hpp"
#include "model/measure/turn.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace kaya {

namespace {

/// Distance outside a block, over its size, within which a point counts as on its surface.
constexpr double on_surface = 1e-6;

/// Shares of a zone's corners in a place; they sum to 1 and may be negative outside of it.
std::array<double, 4> weights_in(const Model& model, Row zone, const Vec3& place) {
    const auto& rows = model.zones.gridpoints[zone];
    const auto& position = model.gridpoints.position;
    const Vec3 origin = position[rows[3]];
    Mat3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = position[rows[static_cast<std::size_t>(k)]] - origin;
    const Vec3 weights = edges.inverse() * (place - origin);
    return {weights[0], weights[1], weights[2], 1 - weights.sum()};
}

bool near_box_of_zone(const Model& model, Row zone, const Vec3& place, double tolerance) {
    const auto& rows = model.zones.gridpoints[zone];
    const auto& position = model.gridpoints.position;
    Vec3 low = position[rows[0]], high = low;
    for (std::size_t k = 1; k < 4; ++k) {
        low = low.cwiseMin(position[rows[k]]);
        high = high.cwiseMax(position[rows[k]]);
    }
    return ((low - place).array() <= tolerance).all() && ((place - high).array() <= tolerance).all();
}

/// The zone that contains the place most deeply.
void place_in_zone(const Model& model, RockPoints& points, Row row, Row block, const Vec3& place, double tolerance) {
    const Span zones = model.blocks.zones[block];
    double best = -std::numeric_limits<double>::infinity();
    const auto try_zones = [&](bool all) {
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            if (!all && !near_box_of_zone(model, zone, place, tolerance)) continue;
            const auto weights = weights_in(model, zone, place);
            const double least = std::ranges::min(weights);
            if (!(least > best)) continue;
            best = least;
            points.zone[row] = zone - zones.first;
            points.weights[row] = weights;
        }
    };
    try_zones(false);
    if (points.zone[row] == no_row) try_zones(true);
}

} // namespace

BlockFinder::BlockFinder(const Model& model) : model_(model), same_(1e-10 * model_size(model)) {
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        const auto [low, high] = block_box(model, block);
        const bool any = model.blocks.gridpoints[block].count > 0;
        boxes_.push_back({low, high, any ? (high - low).norm() : 0});
    }
}

/// Visits blocks within reach of the place, with their distances.
template <class Visit> void BlockFinder::each_near(const Vec3& place, double tolerance, const Visit& visit) const {
    for (Row block = 0; block < static_cast<Row>(boxes_.size()); ++block) {
        const Box& box = boxes_[static_cast<std::size_t>(block)];
        const double most = std::max(tolerance, on_surface * box.size);
        if ((box.low - place).cwiseMax(place - box.high).cwiseMax(Vec3::Zero()).norm() > most) continue;
        const double distance = distance_to(model_, ObjectKind::block, block, place);
        if (distance <= most) visit(block, distance);
    }
}

Row BlockFinder::at(const Vec3& place, double tolerance) const {
    Row best = no_row;
    double best_distance = std::numeric_limits<double>::infinity(), best_centre = best_distance;
    each_near(place, tolerance, [&](Row block, double distance) {
        const double centre = (model_.blocks.centroid[block] - place).squaredNorm();
        if (distance > best_distance + same_ || (distance >= best_distance - same_ && centre >= best_centre)) return;
        best = block;
        best_distance = std::min(distance, best_distance);
        best_centre = centre;
    });
    return best;
}

bool BlockFinder::other_at(const Vec3& place, Row own, double tolerance) const {
    bool found = false;
    each_near(place, tolerance, [&](Row block, double) { found = found || block != own; });
    return found;
}

void place_in_rock(const Model& model, const BlockFinder& finder, RockPoints& points, Row row, const Vec3& place,
                   double tolerance) {
    const auto& blocks = model.blocks;
    const Row block = finder.at(place, tolerance);
    points.zone[row] = no_row;
    points.weights[row] = {};
    points.local[row] = Vec3::Zero();
    points.block[row] = block == no_row ? BlockId{} : blocks.id[block];
    points.shape[row] = block == no_row ? 0 : blocks.shape[block];
    if (block == no_row) return;
    if (blocks.deformable[block])
        place_in_zone(model, points, row, block, place, std::max(tolerance, on_surface * block_size(model, block)));
    else points.local[row] = turn_of(blocks, block).transpose() * (place - blocks.centroid[block]);
}

Vec3 rock_place(const Model& model, const RockPoints& points, Row row) {
    const Row block = rock_block(model, points, row);
    if (points.zone[row] == no_row)
        return model.blocks.centroid[block] + turn_of(model.blocks, block) * points.local[row];
    const auto& corners = model.zones.gridpoints[model.blocks.zones[block].first + points.zone[row]];
    Vec3 place = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) place += points.weights[row][k] * model.gridpoints.position[corners[k]];
    return place + points.local[row];
}

} // namespace kaya
