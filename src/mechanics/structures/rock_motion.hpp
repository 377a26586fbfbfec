// Motion of the rock at points of structures: one rule for cables, beams and liners.
#pragma once

#include "mechanics/lanes/rotation.hpp"
#include "model/measure/structure_rows.hpp"
#include "model/structures/rock_points.hpp"

namespace kaya {

/// Velocity of the rock at a placed row, which is now at `place`.
inline Vec3 rock_velocity(const Model& model, const RockPoints& points, Row row, const Vec3& place) {
    const auto& blocks = model.blocks;
    const Row block = rock_block(model, points, row);
    if (points.zone[row] == no_row)
        return blocks.velocity[block] + blocks.rotational_velocity[block].cross(place - blocks.centroid[block]);
    const auto& corners = model.zones.gridpoints[blocks.zones[block].first + points.zone[row]];
    Vec3 velocity = Vec3::Zero();
    for (std::size_t k = 0; k < 4; ++k) velocity += points.weights[row][k] * model.gridpoints.velocity[corners[k]];
    return velocity;
}

/// The place of the rock at a placed row after a step; `place` is the one before it. In small strain blocks and gridpoints keep their
/// positions, and the row moves away from them.
inline Vec3 follow_rock(const Model& model, RockPoints& points, Row row, const Vec3& place, double step) {
    if (!model.settings.large_strain) {
        const Vec3 shift = step * rock_velocity(model, points, row, place);
        const bool rigid = points.zone[row] == no_row;
        points.local[row] +=
            rigid ? quaternion(model.blocks.orientation[rock_block(model, points, row)]).conjugate() * shift : shift;
    }
    return rock_place(model, points, row);
}

} // namespace kaya
