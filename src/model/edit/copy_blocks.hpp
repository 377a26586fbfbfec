// Copies of blocks in another place.
#pragma once

#include "model/tables/model.hpp"

#include <vector>

namespace kaya {

/// Placement of a copy: a point p of the block moves to turn * p + shift.
struct Placement {
    Mat3 turn = Mat3::Identity(); ///< a rotation or a reflection
    Vec3 shift = Vec3::Zero();

    Vec3 operator()(const Vec3& point) const { return turn * point + shift; }
};

/// The reflection at a plane; the normal is of unit length.
Placement reflection(const Vec3& normal, const Vec3& origin);

/// Adds a copy of each block for each placement, with its zones, faces, material, region and groups: at rest, free, without load and
/// stress. Copies of joined blocks are joined. Rows of the copies follow all others, those of the first placement first, in the order of
/// `blocks`. Returns the row of the first.
Row copy_blocks(Model& model, const std::vector<Row>& blocks, const std::vector<Placement>& placements);

} // namespace kaya
