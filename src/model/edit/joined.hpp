// Joined blocks: concave solids, and blocks joined by a deck. Rigid ones move as one body; zoned ones are tied where their faces are in
// contact (ties.hpp).
#pragma once

#include "model/tables/model.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace kaya {

/// Whether two blocks are parts of one body.
inline bool joined(const Model& model, Row a, Row b) {
    return model.blocks.body[a] != 0 && model.blocks.body[a] == model.blocks.body[b];
}

/// The rigid bodies of more than one block; derived from Blocks::body. Members in ascending order.
struct JoinedBodies {
    std::vector<std::size_t> start{0}; ///< one more than bodies
    std::vector<Row> rows;

    std::size_t size() const { return start.size() - 1; }
    std::span<const Row> members(std::size_t body) const {
        return {rows.data() + start[body], start[body + 1] - start[body]};
    }
};
JoinedBodies joined_bodies(const Model& model);

/// Mass, centroid and inertia about it (global axes) of a body from those of its members. Without masses all densities count as 1.
struct BodyMass {
    double mass = 0;
    Vec3 centroid = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
};
BodyMass body_mass(const Model& model, std::span<const Row> members);

/// A component that is held on a member is held on the body, and moves as on the first such member: sets these components of the velocity of the
/// body and of its spin. Returns the bits of the held ones.
std::uint8_t keep_held(const Blocks& blocks, std::span<const Row> members, Vec3& velocity, Vec3& spin);

/// Joins the pairs of blocks, with those that are joined to them already. The body takes the momentum and angular momentum of its parts.
/// Throws Diagnostic and leaves the model unchanged when one block has zones and another has none.
void join_pairs(Model& model, const std::vector<std::pair<Row, Row>>& pairs);

/// Pairs of the rows with faces in contact.
std::vector<std::pair<Row, Row>> adjacent_pairs(const Model& model, const std::vector<Row>& rows);

/// Separates the bodies that contain any of the rows; each part keeps its motion.
void unjoin(Model& model, const std::vector<Row>& rows);

} // namespace kaya
